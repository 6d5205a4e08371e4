// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/slow/slow_models.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace extremal {

const SlowModel* findSlowModel(const System& system, std::string_view id) {
    const auto* const models = system.parts.find<SlowModels>();
    if (!models) return nullptr;
    const auto found =
        std::find_if(models->all.begin(), models->all.end(), [&](const SlowModel& m) { return m.id == id; });
    return found == models->all.end() ? nullptr : &*found;
}

ReducedModel reducedModel(std::string id, const SlowModel& model) {
    return {std::move(id), [model](const State& initial) {
                const auto d = static_cast<std::size_t>(model.dimension);
                ReducedMotion r;
                r.start.resize(static_cast<std::size_t>(model.size()));
                model.project(initial, r.start.data());
                r.rate = [H = model.hamiltonian(r.start.data()), d, n = r.start.size(),
                          slope = std::vector<double>(2 * d)](const double* y, double* rate) mutable {
                    H.gradient(H.model.get(), 0, y, y + d, slope.data());
                    std::copy_n(slope.data() + d, d, rate);
                    std::transform(slope.data(), slope.data() + d, rate + d, [](double v) { return -v; });
                    std::fill(rate + 2 * d, rate + n, 0.0);
                };
                r.embed = [embed = model.embed](const double* y, double* x) { embed(0, y, x); };
                return r;
            }};
}

}  // namespace extremal
