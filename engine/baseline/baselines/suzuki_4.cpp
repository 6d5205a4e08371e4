// SPDX-License-Identifier: GPL-3.0-or-later
/// Split-step of order 4: five Strang steps, one of them backwards; five kicks per step.
#include "engine/baseline/wave_splitting.hpp"

namespace extremal::baselines {

BaselineEntry suzuki_4() {
    return waveSplittingBaseline(
        "suzuki-4", "Suzuki 4",
        "Split-step of order 4: five Strang steps, one of them backwards; five kicks per step.",
        extremal::suzuki4());
}

}  // namespace extremal::baselines
