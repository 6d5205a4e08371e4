// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/wave/start/soliton.hpp"

#include <algorithm>
#include <cmath>
#include <complex>

#include "engine/core/problem.hpp"
#include "engine/core/text/known_keys.hpp"
#include "engine/core/text/text.hpp"

namespace extremal::wave {
namespace {

constexpr const char *single = "soliton", *pair = "two-soliton", *dark = "dark-soliton-pair";

/// A number among the keys of a packet.
double keyOf(const Value& psi, const std::string& pointer, const char* key, double fallback) {
    const Value* const value = psi.find(key);
    if (!value) return fallback;
    if (!value->isNumber() || !std::isfinite(value->asNumber()))
        throw InvalidScene(pointer + "/" + key, "must be a finite number", formatNumber(fallback));
    return value->asNumber();
}

/// Refuses what these packets have not.
void checkSoliton(const Value& psi, const std::string& pointer, const Hamiltonian& h, double g) {
    const std::string& name = psi.find("packet")->asString();
    const bool isDark = name == dark;
    const std::vector<double>& V = h.potential();
    const bool isFree = std::all_of(V.begin(), V.end(), [](double each) { return each == 0; });
    if (h.dimension() != 1)
        throw InvalidScene(pointer + "/packet", name + " is for the line",
                           "the model schrodinger, or re and im as expressions in x and y");
    if (!(isDark ? g > 0 : g < 0) || !isFree || h.isTimeDependent())
        throw InvalidScene(pointer + "/packet",
                           name + (isDark ? " needs repulsion" : " needs attraction") +
                               " and no potential, and has the interaction " + formatNumber(g, 4) +
                               (isFree ? "" : " and a potential"),
                           std::string("\"interaction\": ") + (isDark ? "1" : "-1") +
                               " and \"potential\": \"free\" of the model, or a Gaussian packet");
    if (isDark && !h.isPeriodic())
        throw InvalidScene(pointer + "/packet",
                           name + " needs a periodic domain: it does not vanish at the ends",
                           "the boundary periodic");
    std::vector<std::string> known{"amplitude", "centre"};
    if (name != pair) known.emplace_back("velocity");
    if (isDark) known.emplace_back("separation");
    allowKeys(psi, "packet", known, pointer, "the packet " + name);
    if (const double A = keyOf(psi, pointer, "amplitude", 1); !(A > 0))
        throw InvalidScene(pointer + "/amplitude", "must be positive, got " + formatNumber(A), "1");
}

/// Two dark solitons that move towards each other, as a product.
LineSolution darkPair(const Value& psi, const std::string& pointer, const Hamiltonian& h, double g) {
    const double A = keyOf(psi, pointer, "amplitude", 1), v = keyOf(psi, pointer, "velocity", 0.4),
                 length = h.domain().length,
                 centre = keyOf(psi, pointer, "centre", h.domain().left + length / 2),
                 separation = keyOf(psi, pointer, "separation", length / 2),
                 sound = A * std::sqrt(g / h.mass()), slowness = v / sound;
    if (!(std::abs(slowness) < 1))
        throw InvalidScene(
            pointer + "/velocity",
            "must be below the speed of sound " + formatNumber(sound, 4) + ", got " + formatNumber(v),
            "a smaller velocity");
    if (!(separation > 0 && separation < length))
        throw InvalidScene(pointer + "/separation",
                           "must be between 0 and the length of the domain, got " + formatNumber(separation),
                           formatNumber(length / 2));
    const double depth = std::sqrt((1 - slowness) * (1 + slowness)),
                 kappa = depth * A * std::sqrt(g * h.mass()) / h.hbar(), rate = g * A * A / h.hbar();
    return [=](double x, double t) {
        const double place = std::remainder(x - centre, length), half = separation / 2 - v * t;
        return A * std::polar(1.0, -rate * t) * Complex(depth * std::tanh(kappa * (place + half)), slowness) *
               Complex(depth * std::tanh(kappa * (place - half)), -slowness);
    };
}

/// (e^{k a} + e^{-k a}) / 2 times e^{-4 a}, for a >= 0 and k <= 4.
double scaledCosh(double k, double a) { return (std::exp((k - 4) * a) + std::exp(-(k + 4) * a)) / 2; }

}  // namespace

std::vector<CatalogItem> solitonPackets() {
    FieldInfo centre = numberField("centre", "centre", "", 0, "The middle of the domain by default.");
    centre.fallback = nullptr;
    FieldInfo separation =
        numberField("separation", "separation", "", 0, "How far apart; half of the domain by default.");
    separation.fallback = nullptr;
    const FieldInfo amplitude = positive("amplitude", "amplitude", "", 1, "A, which sets the width as well.");
    const std::string psi = "a wave function with attraction";
    return {{single,
             "soliton",
             "A sech(kappa (x - centre)) exp(i m velocity x/hbar), kappa = A sqrt(-g m)/hbar: it keeps its "
             "shape. Not scaled.",
             {amplitude, numberField("velocity", "velocity", "", 0, "Of the soliton."), centre},
             {},
             psi},
            {pair,
             "two solitons at rest",
             "2 A sech(kappa (x - centre)): it narrows and widens again and again. Not scaled.",
             {amplitude, centre},
             {},
             psi},
            {dark,
             "two dark solitons",
             "Two notches in a wave of constant density amplitude^2, which move towards each other. Not "
             "scaled.",
             {amplitude, numberField("velocity", "velocity", "", 0.4, "Of each, below the speed of sound."),
              separation, centre},
             {},
             "a wave function with repulsion, around a circle"}};
}

bool vanishesAtEnds(const LineSolution& psi, const Hamiltonian& h) {
    // At the start, from node to node: the smallest value is the one farthest from the centre.
    double least = HUGE_VAL, most = 0;
    for (const double x : h.x()) {
        const double size = std::abs(psi(x, 0));
        least = std::min(least, size);
        most = std::max(most, size);
    }
    return least < 1e-9 * most;
}

std::optional<LineSolution> solitonOf(const Value& psi, const std::string& pointer, const Hamiltonian& h,
                                      double g) {
    const Value* const name = psi.find("packet");
    if (!name || !name->isString()) return {};
    const bool isSingle = name->asString() == single, isDark = name->asString() == dark;
    if (!isSingle && !isDark && name->asString() != pair) return {};
    checkSoliton(psi, pointer, h, g);
    if (isDark) return darkPair(psi, pointer, h, g);
    const double A = keyOf(psi, pointer, "amplitude", 1), v = keyOf(psi, pointer, "velocity", 0),
                 centre = keyOf(psi, pointer, "centre", h.domain().left + h.domain().length / 2);
    const double hbar = h.hbar(), m = h.mass(), kappa = A * std::sqrt(-g * m) / hbar;
    const double length = h.domain().length;
    if (isSingle)
        return [=](double x, double t) {
            const double rate = m * v * v / 2 - hbar * hbar * kappa * kappa / (2 * m),
                         d = std::remainder(x - centre - v * t, length);
            return std::polar(A / std::cosh(kappa * d), (m * v * (d + v * t) - rate * t) / hbar);
        };
    return [=](double x, double t) {
        const double a = std::abs(kappa * std::remainder(x - centre, length)),
                     tau = hbar * kappa * kappa * t / m;
        const Complex top = scaledCosh(3, a) + 3 * scaledCosh(1, a) * std::polar(1.0, 4 * tau);
        const double bottom =
            scaledCosh(4, a) + 4 * scaledCosh(2, a) + 3 * std::exp(-4 * a) * std::cos(4 * tau);
        return 4 * A * std::polar(1.0, tau / 2) * top / bottom;
    };
}

}  // namespace extremal::wave
