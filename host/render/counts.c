// counts.c - the numbers of samples that packets leave behind (SAMPLE_COUNTS), added up.
#include "render/counts.h"

#include <stdlib.h>

#include "base/memory.h"
#include "shared/variant.h"

bool pel_counts_add(struct pel_buffer *buffer, const struct pel_tiling *tiling, int eyes,
                    int pictures, struct pel_render_statistics *statistics) {
    size_t turns = tiling->tiles * (size_t)eyes / (size_t)pictures;
    size_t packets = turns * tiling->packets_per_tile;
    uint32_t(*counts)[SAMPLE_COUNTS] = pel_allocate(packets, sizeof *counts);
    if (!counts || !pel_buffer_read(buffer, 0, packets * sizeof *counts, counts)) {
        free(counts);
        return false;
    }
    uint32_t(*count)[SAMPLE_COUNTS] = counts;
    uint64_t possible = 0;
    for (size_t turn = 0; turn < turns; turn++) {
        uint64_t taken = 0;
        for (size_t i = 0; i < tiling->packets_per_tile; i++, count++) {
            taken += (*count)[SAMPLES_TAKEN];
            statistics->samples_terminated += (*count)[SAMPLES_BEHIND];
            statistics->samples_spared += (*count)[SAMPLES_SPARED];
            statistics->boxes_entered += (*count)[PARTS_ENTERED];
            possible += (*count)[SAMPLES_POSSIBLE];
        }
        statistics->stereo.eye_samples[turn % (size_t)eyes] += taken;
        statistics->samples += taken;
    }
    statistics->samples_skipped = possible - statistics->samples - statistics->samples_terminated -
                                  statistics->samples_spared;
    free(counts);
    return true;
}
