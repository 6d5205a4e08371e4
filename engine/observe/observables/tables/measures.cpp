// SPDX-License-Identifier: GPL-3.0-or-later
/// What a system measures itself.
#include "engine/observe/measured.hpp"

namespace extremal::observables {

std::vector<ObservableEntry> measures() {
    const auto row = [](const char* id, const char* title, const char* description, const char* needs) {
        return measuredObservable({id, title, description, {}, {}, needs});
    };
    return {
        row("casimir", "Casimir",
            "Square of a free body's angular momentum; of tops, its vertical component.", "a rigid body"),
        row("current", "current",
            "Probability current through the middle of the domain, counted to the right.", "a wave function"),
        row("h-min", "smallest element",
            "Length of the smallest element of the mesh; the same at all times where nodes do not move.",
            "a field"),
        row("norm", "norm", "Norm of the wave function, and its change.", "a wave function"),
        row("orthogonality", "orthogonality", "|RᵀR - 1| of the attitude: zero where it is a rotation.",
            "a rigid body"),
        row("position", "position",
            "Mean position of the wave function; on a periodic interval the mean of cos x too.",
            "a wave function"),
        row("spectrum-tail", "spectrum tail",
            "Share of the wave function in the upper eighth of its modes: is N enough?", "a wave function"),
        // The field equation of a periodic field keeps it, and a scheme on a mesh nearly.
        row("translation-momentum", "momentum of translation",
            "-∫u_t u_x of a field, and its change; a mesh is no longer homogeneous, so that it is kept "
            "approximately.",
            "a field"),
    };
}

}  // namespace extremal::observables
