// SPDX-License-Identifier: GPL-3.0-or-later
/// How the way of a Fourier transform is chosen.
#pragma once

namespace extremal {

/// A wise plan is one that FFTW's wisdom knows (model/wave/basis/wisdom.hpp), else an estimated one.
enum class TransformPlanning { wise, estimated, measured };

}  // namespace extremal
