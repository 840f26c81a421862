// vtk_curve.h - what VTK, and so ParaView and Slicer, draws between two nodes of a transfer
// function.
#ifndef PEL_TRANSFER_VTK_CURVE_H
#define PEL_TRANSFER_VTK_CURVE_H

// Spaces in which vtkColorTransferFunction mixes two colours. In PEL_VTK_HSV_WRAP the hue goes the
// shorter way round; in PEL_VTK_STEP the second colour holds throughout.
enum pel_vtk_space {
    PEL_VTK_RGB,
    PEL_VTK_HSV,
    PEL_VTK_HSV_WRAP,
    PEL_VTK_LAB,
    PEL_VTK_DIVERGING,
    PEL_VTK_STEP,
};

// The colour at `share` (0..1) of the way from `a` to `b`; all channels 0..1.
void pel_vtk_colour(double rgb[3], enum pel_vtk_space space, const double a[3], const double b[3],
                    double share);

// The opacity at `share` of the way from `a` to `b`. It reaches their mean at `midpoint` (0..1) and
// is the steeper there the greater `sharpness` is: 0 is linear, 1 a step.
double pel_vtk_opacity(double a, double b, double midpoint, double sharpness, double share);

#endif
