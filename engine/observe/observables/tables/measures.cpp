// SPDX-License-Identifier: GPL-3.0-or-later
/// What a system measures itself.
#include "engine/observe/measured.hpp"

namespace extremal::observables {

std::vector<ObservableEntry> measures() {
    const auto row = [](const char* id, const char* title, const char* description, const char* needs) {
        return measuredObservable({id, title, description, {}, {}, needs});
    };
    return {
        row("angular-momentum", "angular momentum",
            "Mean angular momentum of a wave function on a rectangle about its middle; of a field "
            "-∫u_t (x u_y - y u_x), which a periodic rectangle keeps nearly only.",
            "a wave function or a field in the plane"),
        row("casimir", "Casimir",
            "What the bracket keeps: the square of a free body's momentum; of tops, its vertical component; "
            "of a typed bracket those that are named. And the largest change.",
            "a rigid body, a free Lie group or a bracket with Casimirs"),
        row("charge", "charge",
            "∫(u v_t - v u_t) of two components that the equations do not tell from each other when they are "
            "turned, and its change: kept to round-off by every scheme of the framework.",
            "a field with such components"),
        row("current", "current",
            "Probability current through the middle of the domain, counted to the right.", "a wave function"),
        row("group-distance", "distance from the group",
            "How far g is from its group: the largest defect of what the basis leaves invariant; of points "
            "on "
            "spheres, how far they are from length 1 and their momenta from the tangent planes.",
            "a Lie group or points on spheres"),
        row("h-min", "smallest element",
            "Length of the smallest element of the mesh; the same at all times where nodes do not move.",
            "a field"),
        row("norm", "norm",
            "Norm of the wave function, or length of the spin that is furthest from 1, and its change.",
            "a wave function or spins"),
        row("orthogonality", "orthogonality", "|RᵀR - 1| of the attitude: zero where it is a rotation.",
            "a rigid body"),
        row("position", "position",
            "Mean position of the wave function; on a periodic interval the mean of cos x too.",
            "a wave function"),
        row("spins", "spins", "The components of every spin, or the places of vortices.", "spins"),
        row("spectrum-tail", "spectrum tail",
            "Share of the function in the upper eighth of its modes: is N enough?",
            "a wave function, or a periodic field"),
        row("vortices", "vortices",
            "How many cells of the grid the phase of a wave function turns around once, to either side, "
            "where "
            "its density is above a thousandth of the largest.",
            "a wave function in the plane"),
        row("div-e", "divergence of E",
            "Of two components on the edges of the cells, the potential (a, b) of electrodynamics: the largest "
            "div ∂L/∂u_t at a node, with the masses at the edges, and its largest change. Without currents it "
            "stays at every node, which the trapezoidal rule in space keeps to round-off.",
            "a typed density with components on edges"),
        row("edge", "edge",
            "The largest |ψ| at the edges of the domain over the largest of all: is the domain wide enough?",
            "a periodic wave function"),
        row("width", "width", "Mean squares of the distances from the middle of the domain, along x and y.",
            "a periodic wave function"),
        // The field equation of a periodic field keeps it, and a scheme on a mesh nearly.
        row("translation-momentum", "momentum of translation",
            "-∫u_t u_x of a field, over a rectangle along both axes, and its change; a mesh is no longer "
            "homogeneous, so that it is kept "
            "approximately; Fourier modes with exact nodes keep it to round-off.",
            "a field"),
    };
}

}  // namespace extremal::observables
