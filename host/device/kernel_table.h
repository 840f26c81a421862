// kernel_table.h - the kernel files as they were when the library was built.
#ifndef PEL_DEVICE_KERNEL_TABLE_H
#define PEL_DEVICE_KERNEL_TABLE_H

struct pel_kernel_file {
    const char *name; // path below kernels/, such as "shared/world.h"
    const char *text;
};

// Ends with a row of NULLs.
extern const struct pel_kernel_file pel_kernel_table[];

#endif
