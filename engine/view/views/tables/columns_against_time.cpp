// SPDX-License-Identifier: GPL-3.0-or-later
/// Views that draw a column of an observable against time. The monitor is what stationarity in the times
/// makes equal on all steps.
#include "engine/view/catalog.hpp"

namespace extremal::views {

std::vector<ViewEntry> columns_against_time() {
    return {
        {.item =
             viewItem("adiabatic-invariant", "Adiabatic invariant",
                      "fast energy over its frequency against time; nearly constant over very long times"),
         .recipe = ColumnAgainstTime{"adiabatic_invariant", true},
         .scales = againstTime,
         .observable = "adiabatic-invariant"},
        {.item = viewItem("fast-energy", "Fast energy",
                          "energy of the fast oscillation against time; for models that know a fast "
                          "oscillation of their own"),
         .recipe = ColumnAgainstTime{"fast_energy"},
         .scales = againstTime,
         .observable = "fast-energy"},
        {.item = viewItem("floquet", "Floquet trace",
                          "trace of the product of the tangent maps of all steps, against time: after one "
                          "period the sum of the multipliers"),
         .recipe = ColumnAgainstTime{"floquet_trace"},
         .scales = againstTime,
         .observable = "floquet"},
        {.item = viewItem("slow-energy", "Slow energy",
                          "energy without that of the fast oscillation against time"),
         .recipe = ColumnAgainstTime{"slow_energy"},
         .scales = againstTime,
         .observable = "slow-energy"},
        {.item = viewItem("work", "Work",
                          "work of forces, and of constraints that move with time, since the start"),
         .recipe = ColumnAgainstTime{"work"},
         .scales = againstTime,
         .observable = "balance"},
        {.item =
             viewItem("amplification", "Amplification",
                      "by how much each step amplifies the error that there was before it, |M e| / |e|", {}),
         .recipe = ColumnAgainstTime{"amplification"},
         .scales = againstTime,
         .observable = "local-error"},
        {.item = viewItem("h-min", "Smallest element",
                          "length of the smallest element of the mesh of a field against time"),
         .recipe = ColumnAgainstTime{"h_min"},
         .scales = againstTime,
         .observable = "h-min"},
        {.item = viewItem("monitor", "Equidistribution monitor",
                          "step times the root of the density of the local action error, against time: "
                          "constant but for O(h²) between resets"),
         .recipe = ColumnAgainstTime{"monitor", true},
         .scales = againstTime,
         .observable = "solvability"},
    };
}

}  // namespace extremal::views
