// SPDX-License-Identifier: GPL-3.0-or-later
/// FFTW's wisdom, where somebody wants it: which ways of making a transform were measured as the fastest on a
/// machine.
///
/// Plans are estimated unless told otherwise, as a plan measured at the start of a run changes the last bits
/// from run to run. Wisdom is measured once and kept in a file: runs with the same file give the same bits
/// again.
#pragma once

#include <string>
#include <vector>

namespace extremal {

/// Plans made from now on follow this file, which is FFTW's own; sizes that it does not know are estimated.
/// Throws std::runtime_error with the reason.
void useWisdom(const std::string& file);

/// nx nodes, or nx by ny.
struct TransformSize {
    int nx = 0, ny = 1;
};
/// Microseconds of a transform there and back, of complex numbers (wave functions) and of real ones (fields).
struct TransformGain {
    double estimated = 0, measured = 0, realEstimated = 0, realMeasured = 0;
};
/// Measures the ways of both directions of both transforms; takes seconds for large ones.
TransformGain measureTransform(const TransformSize& size);
/// All that was measured or read so far, as the content of a file.
std::string wisdom();

}  // namespace extremal
