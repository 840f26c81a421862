// types.h - the fixed-size types of structs that host C and OpenCL C share.
//
// Members are i32, u32, float, float4 and int4, and arrays and structs of these; never float3,
// bool, size_t, enum or a pointer. Both compilers check every size (SHARED_ASSERT), and a test asks
// the device for every offset.
#ifndef SHARED_TYPES_H
#define SHARED_TYPES_H

#ifdef __OPENCL_C_VERSION__
typedef int i32;
typedef uint u32;
#define SHARED_ASSERT(condition, name) typedef char shared_assert_##name[(condition) ? 1 : -1]
#else
#include <stdint.h>
typedef int32_t i32;
typedef uint32_t u32;
typedef struct {
    _Alignas(16) float x;
    float y, z, w;
} float4;
typedef struct {
    _Alignas(16) int32_t x;
    int32_t y, z, w;
} int4;
#define SHARED_ASSERT(condition, name) _Static_assert(condition, #name)
#endif

#endif
