// scene_source.c - what a scene was made of.
#include "world/scene_source.h"

#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/memory.h"
#include "world/scene_override.h"

// "volumes.ct.density=1" as "volumes.0.density=1", so that everybody sees which volume is meant.
// Memory to free(), or NULL.
static char *resolve_override(const char *override, const json_t *root) {
    size_t length = strcspn(override, "="), bytes = strlen(override) + 16;
    char *key = pel_copy_text(override), *resolved = pel_allocate(bytes, 1);
    bool good = key && resolved;
    if (good) {
        key[length] = '\0';
        good =
            pel_scene_key_resolve(resolved, bytes, root, key) || pel_fail_in("--set %s", override);
    }
    if (good)
        strcat(resolved, override + length);
    free(key);
    if (good)
        return resolved;
    free(resolved);
    return NULL;
}

static bool apply_overrides(struct pel_scene_source *source,
                            const struct pel_scene_document *document) {
    char **overrides = pel_allocate((size_t)document->override_count + 1, sizeof *overrides);
    if (!overrides)
        return false;
    source->document.overrides = (const char *const *)overrides;
    for (int i = 0; i < document->override_count; i++) {
        overrides[i] = resolve_override(document->overrides[i], source->root);
        if (!overrides[i])
            return false;
        source->document.override_count = i + 1;
        if (!pel_scene_override(source->root, overrides[i]))
            return false;
    }
    return true;
}

struct pel_scene_source *pel_scene_source_create(const struct pel_scene_document *document,
                                                 const json_t *root) {
    struct pel_scene_source *source = pel_allocate(1, sizeof *source);
    if (!source)
        return NULL;
    source->document.path = document->path ? pel_copy_text(document->path) : NULL;
    source->document.text = document->text ? pel_copy_text(document->text) : NULL;
    source->root = json_deep_copy(root);
    bool good = (source->document.path || !document->path) &&
                (source->document.text || !document->text) &&
                (source->root || pel_fail(PEL_ERROR_MEMORY, "cannot allocate a scene"));
    if (good && apply_overrides(source, document))
        return source;
    pel_scene_source_destroy(source);
    return NULL;
}

void pel_scene_source_destroy(struct pel_scene_source *source) {
    if (!source || __atomic_fetch_sub(&source->shares, 1, __ATOMIC_ACQ_REL) > 0)
        return;
    for (int i = 0; i < source->document.override_count; i++)
        free((char *)source->document.overrides[i]);
    free((char **)source->document.overrides);
    free((char *)source->document.path);
    free((char *)source->document.text);
    json_decref(source->root);
    free(source);
}

struct pel_scene_source *pel_scene_source_share(struct pel_scene_source *source) {
    if (source)
        __atomic_fetch_add(&source->shares, 1, __ATOMIC_RELAXED);
    return source;
}
