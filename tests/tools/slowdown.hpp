// SPDX-License-Identifier: GPL-3.0-or-later
/// How many times longer searches take in a build with sanitizers.
#pragma once

namespace extremal::tests {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr int slowdown = 40;
#else
inline constexpr int slowdown = 1;
#endif

}  // namespace extremal::tests
