// event.c - a growing queue of events.
#include "viewer/event.h"

#include <stdlib.h>
#include <string.h>

bool pel_event_push(struct pel_event_queue *queue, const struct pel_event *event) {
    if (queue->count > 0 && event->kind == PEL_EVENT_POINTER) {
        struct pel_event *last = &queue->events[queue->first + queue->count - 1];
        if (last->kind == PEL_EVENT_POINTER && last->window == event->window) {
            *last = *event;
            return true;
        }
    }
    if (queue->first > 0 && queue->first + queue->count == queue->capacity) {
        memmove(queue->events, queue->events + queue->first,
                (size_t)queue->count * sizeof *queue->events);
        queue->first = 0;
    }
    if (queue->count == queue->capacity) {
        int capacity = queue->capacity ? 2 * queue->capacity : 64;
        struct pel_event *events = realloc(queue->events, (size_t)capacity * sizeof *events);
        if (!events)
            return false;
        queue->events = events;
        queue->capacity = capacity;
    }
    queue->events[queue->first + queue->count++] = *event;
    return true;
}

bool pel_event_take(struct pel_event_queue *queue, struct pel_event *event) {
    if (queue->count == 0)
        return false;
    *event = queue->events[queue->first++];
    if (--queue->count == 0)
        queue->first = 0;
    return true;
}

void pel_event_finish(struct pel_event_queue *queue) {
    struct pel_event event;
    while (pel_event_take(queue, &event))
        free(event.path);
    free(queue->events);
    *queue = (struct pel_event_queue){0};
}
