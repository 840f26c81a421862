// variant.c - which kernel a frame needs, and the -D definitions that make it.
#include "render/variant.h"

#include <stdio.h>

#include "shared/recipe.h"

static int skip_knob(enum pel_skip skip) {
    switch (skip) {
    case PEL_SKIP_NONE:
        return SKIP_NONE;
    case PEL_SKIP_GRID:
        return SKIP_GRID;
    case PEL_SKIP_OCTREE:
        return SKIP_OCTREE;
    case PEL_SKIP_BVH:
        return SKIP_BVH;
    case PEL_SKIP_BLOCKS:
        return SKIP_BLOCKS;
    case PEL_SKIP_AUTO:
    case PEL_SKIP_DISTANCE:
        break;
    }
    return SKIP_DISTANCE;
}

struct pel_variant pel_variant_choose(const struct pel_world *world, enum pel_reader reader,
                                      enum pel_skip skip, int lanes, uint64_t constant_bytes) {
    int parts = world->bytes.part_count;
    return (struct pel_variant){
        .lanes = lanes,
        .group_rows = 1,
        .reader = reader == PEL_READER_IMAGE ? READER_IMAGE : READER_BUFFER,
        // An empty scene still needs a kernel that compiles.
        .voxels = world->voxels ? world->voxels : VOXELS_U8,
        .filters = world->filters ? world->filters : FILTERS_LINEAR,
        .mixing = world->mixing,
        .models = world->models,
        .clip = world->clipped,
        .masked = world->masked,
        .skip = skip_knob(skip),
        .pool = world->pool,
        .border = world->border,
        .eyes = world->eyes,
        .capacity = parts <= 1   ? 1
                    : parts <= 8 ? 8
                                 : WORLD_PART_MAX,
        .shading = world->shaded,
        .style = world->styled,
        .secondary = world->secondary,
        .table_linear = world->table_linear,
        .supersampling = world->supersampling,
        .jitter = world->jitter,
        .live = world->live_count > 0,
        .adaptive = world->adaptive,
        .probe = world->probe,
        .debug = world->bytes.debug != DEBUG_NONE && world->bytes.debug != DEBUG_TIME,
        // Recipes are in constant memory, too.
        .table_global = pel_world_bytes(world) + world->tables->count * sizeof(u32) +
                            (size_t)world->live_count * sizeof(struct recipe) >
                        constant_bytes,
    };
}

void pel_variant_write(const struct pel_variant *variant, char text[PEL_VARIANT_BYTES]) {
    snprintf(text, PEL_VARIANT_BYTES,
             "-cl-std=CL1.2 -DLANES=%d -DREADER=%d -DVOXELS=%d -DFILTERS=%d -DMIXING=%d -DSKIP=%d "
             "-DCAPACITY=%d -DSHADING=%d -DTABLE_LINEAR=%d -DTABLE_SPACE=%s "
             "-DSUPERSAMPLING=%d -DJITTER=%d -DDEBUG=%d -DPROBE=%d -DMODELS=%d "
             "-DGROUP_ROWS=%d -DPOOL=%d -DCLIP=%d -DSTYLE=%d -DLIVE=%d -DEYES=%d -DMASKED=%d "
             "-DSECONDARY=%d -DBORDER=%d -DADAPTIVE=%d",
             variant->lanes, variant->reader, variant->voxels, variant->filters, variant->mixing,
             variant->skip, variant->capacity, variant->shading, variant->table_linear,
             variant->table_global ? "__global" : "__constant", variant->supersampling,
             variant->jitter, variant->debug, variant->probe, variant->models, variant->group_rows,
             variant->pool, variant->clip, variant->style, variant->live, variant->eyes,
             variant->masked, variant->secondary, variant->border, variant->adaptive);
}
