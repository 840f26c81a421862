// history.h - undo and redo of everything: a row of scenes, one for each step.
//
// Scenes share their volumes, so a step costs about a hundred kilobytes. A removed volume stays in
// memory as long as a step can bring it back.
#ifndef PEL_VIEWER_HISTORY_H
#define PEL_VIEWER_HISTORY_H

#include "pellucid.h"

// Begins with a scene that nothing was done to yet, and keeps at most `steps_max` steps (at least
// 1). NULL: memory ran out.
struct pel_history *pel_history_create(const struct pel_scene *scene, int steps_max);
void pel_history_destroy(struct pel_history *history);

// The scene was changed to this, by something that is called `what` in the menu ("move ct"). What
// was undone before is forgotten. Calls with one `merge`, other than 0, that follow each other
// without pel_history_settle between them are one step: a drag. False (memory) leaves the history
// as it was.
bool pel_history_record(struct pel_history *history, const struct pel_scene *scene,
                        const char *what, uint64_t merge);

// A drag ended: the next change is a step of its own.
void pel_history_settle(struct pel_history *history);

// One step back or forward: a copy of the scene as it was then, for the caller to own. NULL when
// there is no such step or no memory.
struct pel_scene *pel_history_undo(struct pel_history *history);
struct pel_scene *pel_history_redo(struct pel_history *history);

// What undo and redo would undo and redo; NULL when there is nothing.
const char *pel_history_undo_name(const struct pel_history *history);
const char *pel_history_redo_name(const struct pel_history *history);

// The scene as it is saved on disk is the present one; and whether it still is.
void pel_history_mark_saved(struct pel_history *history);
bool pel_history_is_saved(const struct pel_history *history);

#endif
