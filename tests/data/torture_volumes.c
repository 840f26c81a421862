// torture_volumes.c - every odd, rare and broken file that other projects keep for their readers
// gives a volume or a sentence, within a second or so and within an address-space limit; and so do
// damaged versions of real PVM and MetaImage files.
#include "support/file.h"

#include <ftw.h>
#include <signal.h>
#include <sys/resource.h>
#include <unistd.h>

enum { SECONDS_PER_FILE = 30, DAMAGES = 300 };

static int file_count, volume_count;
static char current[1024];

static void too_slow(int number) {
    (void)number;
    (void)!write(2, current, strlen(current));
    (void)!write(2, ": took too long\n", 16);
    _exit(1);
}

// Loads a file and looks at the answer.
static void check(const char *path) {
    snprintf(current, sizeof current, "%s", path);
    alarm(SECONDS_PER_FILE);
    struct pel_volume *volume = pel_volume_load(path, NULL);
    alarm(0);
    file_count++;
    if (volume) {
        volume_count++;
        if (!volume->voxels || pel_volume_bytes(volume) == 0)
            fail_msg("%s: an empty volume", path);
        pel_volume_value(volume, volume->dims[0] - 1, volume->dims[1] - 1, volume->dims[2] - 1);
    } else {
        const char *message = pel_error_message();
        if (pel_error_code() == PEL_OK || strncmp(message, path, strlen(path)) != 0 ||
            strstr(message, "cannot allocate") || strchr(message, '\n'))
            fail_msg("%s: code %d, '%s'", path, (int)pel_error_code(), message);
    }
    pel_volume_destroy(volume);
}

static int visit(const char *path, const struct stat *status, int kind, struct FTW *level) {
    (void)status, (void)level;
    if (kind == FTW_F)
        check(path);
    return 0;
}

static void check_folder(const char *relative, int least_files, int least_volumes) {
    file_count = volume_count = 0;
    assert_int_equal(nftw(test_data_path(relative), visit, 16, FTW_PHYS), 0);
    print_message("%s: %d volumes of %d files\n", relative, volume_count, file_count);
    assert_true(file_count >= least_files);
    assert_true(volume_count >= least_volumes);
}

static void test_nrrd_folder(void **state) {
    (void)state;
    check_folder("data/torture_nrrd", 22, 20);
}

static void test_nifti_folder(void **state) {
    (void)state;
    check_folder("data/torture_nifti", 120, 50);
}

static void test_equivalent_formats_folder(void **state) {
    (void)state;
    check_folder("data/torture_formats_equiv", 30, 6);
}

// Cuts and flips bits of `relative` and loads it as `leaf`, or loads the header that names it.
static void damage(const char *relative, const char *leaf, const char *loaded) {
    struct test_bytes file = test_read(test_data_path(relative));
    uint64_t random = 99;
    for (int i = 0; i < DAMAGES; i++) {
        struct test_bytes copy = {0};
        test_put(&copy, file.bytes, file.count);
        if (i % 3 == 0)
            copy.count = (size_t)(test_random(&random) * (double)file.count);
        // Half of the flips hit the header, where they hurt.
        double reach = i % 2 ? 64 : (double)file.count;
        for (int j = 0; j < 3 && i % 3 != 0; j++) {
            size_t at = (size_t)(test_random(&random) * reach);
            copy.bytes[at < copy.count ? at : 0] ^=
                (unsigned char)(1u << (unsigned)(test_random(&random) * 8));
        }
        test_write(leaf, copy.bytes, copy.count);
        check(test_temporary_path(loaded));
        test_release(&copy);
    }
    test_write(leaf, file.bytes, file.count);
    check(test_temporary_path(loaded));
    test_release(&file);
}

static void test_damaged_pvm(void **state) {
    (void)state;
    damage("data/bucky32/Bucky.pvm", "Bucky.pvm", "Bucky.pvm");
}

static void test_damaged_metaimage(void **state) {
    (void)state;
    struct test_bytes raw = test_read(test_data_path("data/nucleon41/nucleon.raw"));
    test_write("nucleon.raw", raw.bytes, raw.count);
    test_release(&raw);
    damage("data/nucleon41/nucleon.mhd", "nucleon.mhd", "nucleon.mhd");
    damage("data/nucleon41/nucleon.raw", "nucleon.raw", "nucleon.mhd");
}

int main(void) {
    test_need_data("data/torture_nrrd");
    signal(SIGALRM, too_slow);
#ifndef __SANITIZE_ADDRESS__
    // The largest of these files holds 45 MB of voxels. The address sanitizer reserves terabytes.
    setrlimit(RLIMIT_AS, &(struct rlimit){1u << 30, 1u << 30});
#endif
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_nrrd_folder),
        cmocka_unit_test(test_nifti_folder),
        cmocka_unit_test(test_equivalent_formats_folder),
        cmocka_unit_test(test_damaged_pvm),
        cmocka_unit_test(test_damaged_metaimage),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
