// Voxelisation on a Vulkan device, in three submissions with counts read back in between:
//   mark_hull, scan_cells, add_blocks           the cells that triangles touch, and their number
//   mark_hull (lists), list_hull, trace_lines    three axes of lines through centres and fill samples
//   count_votes                                 -> core bits, fill bits, doubtful samples
//   list_undecided, compute_winding                 the generalised winding number, only for doubtful samples
#pragma once

#include "mesh/gpu/job.hpp"
#include "mesh/voxelise.hpp"

namespace sinew::mesh::gpu {

/// Gives the same voxels as mesh::voxelise. Votes are counted in integers on vertices rounded to 2^-24 cells
/// (in a grid of 128 cells), so they are the same on every device; a doubtful sample within rounding of |w| =
/// 1/2 may differ. Device and queue must outlive it; one thread; every call submits to the queue and waits.
class Voxeliser {
public:
    /// Creates no pipeline: the first call does. isReversed: a test of order (kernel.glsl).
    Voxeliser(const vk::Device& device, vk::Queue& queue, bool isReversed = false)
        : device_(device.anchored()), queue_(queue), kernels_(device, isReversed) {}

    /// Throws as mesh::voxelise does, and vk::Error: outOfMemory if a buffer exceeds the device's binding
    /// size, for example with more than 32 Mi pairs of a triangle and a cell that it touches at 128 MiB a
    /// binding.
    VoxelGrid operator()(const TriangleMesh& mesh, const VoxelRequest& request);

private:
    const vk::Device& device_;
    vk::Queue& queue_;
    Kernels kernels_;
};

} // namespace sinew::mesh::gpu
