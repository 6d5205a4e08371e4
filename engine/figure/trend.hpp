// SPDX-License-Identifier: GPL-3.0-or-later
/// Whether an error e(t) drifts over a run or only fluctuates, or whether the run is too short to tell.
///
/// The finite values e_1, ..., e_n, in their order, are cut into m = min(48, n/2) blocks. Two sequences are
/// examined: the means y_i of the blocks, for a drift of the level, and their half ranges w_i, for a
/// fluctuation that grows or shrinks. For each sequence z of the two, with r(z) = max z - min z and the half
/// range E of all values, the first line that applies decides:
///
///  1. r(z) <= E/20: no drift; what there may be is small beside the fluctuation.
///  2. |tau| >= 0.9, Kendall's tau of z: drift; z moves in one direction throughout.
///  3. |z_1 - mean of the late half| > 4 r(late half), or the same of z_m and the early half: too short. z
///     went to another level once, by a jump or from its start; whether it comes back was not seen.
///  4. N = m/T < 12: too short. T is the integrated autocorrelation time, in blocks, of the residuals of the
///     line that is fitted to z.
///  5. |D| > 5 s(D) and |D| > E/20: drift. D is the change of that line over the run and
///     s(D)^2 = 12 s^2 T/m its variance, where s^2 is the variance of the residuals.
///  6. Otherwise: no drift.
///
/// A drift in either sequence is a drift; otherwise one that is too short leaves the whole open. N counts
/// independent values; for a modulation of p periods N = m/(1 + m/(pi p)), so that it takes five periods to
/// be told from a drift. A random walk has N of about 8 whatever its length, and mostly stays open. What
/// never exceeds `noise`, the size of round-off, does not drift. One infinite value is a drift.
///
/// T = 1 + 2 sum of the autocorrelations up to the first that is not positive (Sokal 1997, "Monte Carlo
/// methods in statistical mechanics", sec. 3, with the simplest window). Limits and counts were chosen on
/// simulated series of 14 kinds: noise and oscillations of any speed were called a drift in at most 1.5 % of
/// the cases (short peaks in 3 %), and growth of twice the fluctuation in at least 95 %
/// (tests/engine/figure/trend_test.cpp).
#pragma once

#include <span>

namespace extremal {

enum class Trend { none, drift, open };

Trend trendOf(std::span<const double> values, double noise);

}  // namespace extremal
