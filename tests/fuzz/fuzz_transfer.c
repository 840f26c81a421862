// fuzz_transfer.c - the reader of transfer functions, Pellucid's own and ParaView's.
#include "support/fuzz.h"

#include <math.h>
#include <stdlib.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    struct pel_transfer *transfer = pel_transfer_load(fuzz_file("input.json", data, size));
    if (!transfer) {
        fuzz_expect_error();
        return 0;
    }
    // Values from 0 to 100, each percentile its own number.
    struct pel_statistics statistics = {.max = 100, .count = 101};
    for (int i = 0; i <= 100; i++)
        statistics.percentiles[i] = i;
    pel_transfer_resolve(transfer, &statistics);
    for (int i = -10; i <= 110; i++) {
        double rgba[4];
        pel_transfer_evaluate(transfer, i, rgba);
        for (int c = 0; c < 4; c++)
            if (!(rgba[c] >= 0 && rgba[c] <= 1))
                abort();
    }
    pel_transfer_destroy(transfer);
    return 0;
}
