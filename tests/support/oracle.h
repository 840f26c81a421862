// oracle.h - the scenes of which other systems made pictures, in our terms.
#ifndef PEL_TEST_ORACLE_H
#define PEL_TEST_ORACLE_H

#include "support/test.h"

// One picture of the data folder, and how near two correct renderers are to each other there.
struct oracle_picture {
    const char *file; // below the data folder
    enum oracle_system { ORACLE_OPENVKL, ORACLE_VTK, ORACLE_CUDA } system;
    const char *transfer; // file of 256 x RGBA; NULL for CUDA's own table
    int copies;           // of the volume
    double bound_255;     // of the difference,
    int exception_count;  // but for so many pixels in a full picture,
    double exception_255; // which may be this far off
    bool shaded;          //
};

// Ends with a row without file.
extern const struct oracle_picture oracle_pictures[];

// Runs a test for each picture, which is its initial state; returns the program's exit status.
// Skips the program when the data is missing.
int oracle_run(const char *name, CMUnitTestFunction test);

// The scene of a picture. Its background is opaque black, and its picture is what the file holds.
struct pel_scene *oracle_scene(const struct oracle_picture *picture);

// The file, its first row the top one as seen by the camera of oracle_scene; alpha is 1.
struct pel_image *oracle_read(const struct oracle_picture *picture);

// A channel, 0..1, as the picture's system stores it in a byte, over 255.
double oracle_stored(const struct oracle_picture *picture, double channel);

// The phase that puts our samples where the other system's are, for a pixel. A system that counts
// samples from the far end needs one of its own for each ray: the one returned is a little less, as
// our spans do not include their far end.
double oracle_phase(const struct oracle_picture *picture, const struct pel_scene *scene, int x,
                    int y);

#endif
