// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/wave/start/packet.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <utility>

#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"
#include "engine/model/wave/start/cloud.hpp"
#include "engine/model/wave/start/eigenstate.hpp"
#include "engine/model/wave/start/soliton.hpp"
#include "engine/model/wave/start/vortices.hpp"

namespace extremal::wave {
namespace {

constexpr double twoPi = 2 * std::numbers::pi;

struct Context {
    const std::string& pointer;
    const std::shared_ptr<const Hamiltonian>& hamiltonian;
    const Constants& constants;
    const Grid& grid() const { return hamiltonian->grid(); }
};

std::vector<Complex> fromNodes(const Context& context, const std::vector<Complex>& psi) {
    const Hamiltonian& h = *context.hamiltonian;
    for (std::size_t j = 0; j < psi.size(); ++j)
        if (!std::isfinite(psi[j].real()) || !std::isfinite(psi[j].imag()))
            throw InvalidScene(
                context.pointer,
                "is not finite at x = " + formatNumber(h.x()[j % h.x().size()], 6) +
                    (h.dimension() == 2 ? ", y = " + formatNumber(h.y()[j / h.x().size()], 6) : ""));
    std::vector<Complex> c(psi.size());
    h.toCoefficients(psi.data(), c.data());
    return c;
}

/// psi(x, y) = f_x(x) f_y(y); on an interval without the second.
using Factor = std::function<Complex(double)>;
std::vector<Complex> product(const Context& context, const std::vector<Factor>& factors) {
    std::vector<Complex> along, values;
    for (const double x : context.hamiltonian->x()) along.push_back(factors[0](x));
    for (const double y : context.hamiltonian->y()) {
        const Complex across = factors.size() > 1 ? factors[1](y) : 1;
        for (const Complex& f : along) values.push_back(factors.size() > 1 ? f * across : f);
    }
    return fromNodes(context, values);
}

/// re and im in the variables of the grid.
std::vector<Function> expressionsOf(const Context& context, const Value& psi) {
    std::vector<Function> parts;
    for (const char* key : {"re", "im"}) {
        const Value* text = psi.find(key);
        const std::string place = context.pointer + "/" + key;
        if (!text) {
            parts.push_back({[](double, double, double) { return 0.0; }, false});
        } else if (text->isNumber()) {
            parts.push_back({[v = text->asNumber()](double, double, double) { return v; }, false});
        } else if (text->isString()) {
            parts.push_back(functionOf(text->asString(), place, context.constants,
                                       {context.grid().dimension() == 2, false}));
        } else {
            throw InvalidScene(place, context.grid().dimension() == 2 ? "must be an expression in x and y"
                                                                      : "must be an expression in x");
        }
    }
    parametersOf(psi, context.pointer, {}, {"re", "im"}, context.constants);
    return parts;
}

std::vector<Complex> expressions(const Context& context, const Value& psi) {
    const std::vector<Function> parts = expressionsOf(context, psi);
    std::vector<Complex> values;
    for (const double y : context.hamiltonian->y())
        for (const double x : context.hamiltonian->x())
            values.emplace_back(parts[0].value(x, y, 0), parts[1].value(x, y, 0));
    return fromNodes(context, values);
}

std::vector<Complex> given(const Context& context, const Value& values) {
    const auto n = static_cast<std::size_t>(context.hamiltonian->size());
    std::vector<Complex> psi(n);
    for (const char* key : {"re", "im"}) {
        const Value* numbers = values.find(key);
        const std::string place = context.pointer + "/values/" + key;
        if (!numbers && std::string_view(key) == "im") continue;
        if (!numbers || !numbers->isArray() || numbers->asArray().size() != n)
            throw InvalidScene(
                place,
                "must have " + std::to_string(n) + " numbers, one per node" +
                    (numbers && numbers->isArray() ? ", got " + std::to_string(numbers->asArray().size())
                                                   : std::string()),
                context.grid().dimension() == 2
                    ? "the number of nodes is /model/modes times /model/modes_y, x first"
                    : "the number of nodes is /model/modes");
        for (std::size_t j = 0; j < n; ++j) {
            const double v =
                numberIn(numbers->asArray()[j], place + "/" + std::to_string(j), context.constants);
            psi[j] += std::string_view(key) == "re" ? Complex(v, 0) : Complex(0, v);
        }
    }
    return fromNodes(context, psi);
}

std::vector<Complex> eigenstate(const Context& context, const Value& psi) {
    const double n = parametersOf(psi, context.pointer, {{"n", 0}}, {"packet"}, context.constants)[0];
    return eigenstateOf(context.hamiltonian, n, context.pointer);
}

/// Keys of a packet: reads those of the axes one after the other, those of y with _y at their end; as many
/// values for each.
std::vector<double> axisKeys(const Context& context, const Value& psi, const std::vector<Domain>& axes,
                             const std::function<std::vector<Parameter>(const Domain&, bool isY)>& keysOf) {
    std::vector<Parameter> all;
    for (const Domain& axis : axes)
        for (Parameter p : keysOf(axis, &axis != &axes.front())) {
            if (&axis != &axes.front()) p.key += "_y";
            all.push_back(std::move(p));
        }
    return parametersOf(psi, context.pointer, all, {"packet"}, context.constants);
}

std::vector<Domain> axesOf(const Hamiltonian& h) {
    return h.dimension() == 2 ? std::vector{h.grid().x, h.grid().y} : std::vector{h.grid().x};
}

double middleOf(const Domain& axis) { return axis.left + axis.length / 2; }

/// One factor for each axis.
std::vector<Factor> gaussians(const Context& context, const Value& psi) {
    const Hamiltonian& h = *context.hamiltonian;
    const std::vector<Domain> axes = axesOf(h);
    const auto p = axisKeys(context, psi, axes, [&](const Domain& axis, bool) -> std::vector<Parameter> {
        return {{"centre", middleOf(axis)}, {"width", axis.length / 20, false, true}, {"wave_number", 0}};
    });
    std::vector<Factor> factors;
    for (std::size_t i = 0; i < axes.size(); ++i)
        factors.push_back([centre = p[3 * i], width = p[3 * i + 1], k = p[3 * i + 2], L = axes[i].length,
                           period = h.isPeriodic() ? axes[i].length : 0](double x) {
            const double d = x - centre - period * std::round((x - centre) / L);
            return std::exp(-d * d / (4 * width * width)) * std::polar(1.0, k * (centre + d));
        });
    return factors;
}

std::vector<Complex> packet(const Context& context, const Value& psi, const std::string& name) {
    if (name == "gaussian") return product(context, gaussians(context, psi));
    const Hamiltonian& h = *context.hamiltonian;
    const std::vector<Domain> axes = axesOf(h);
    std::vector<Factor> factors;
    if (!h.isPeriodic() && (name == "periodic-gaussian" || name == "plane-wave"))
        throw InvalidScene(context.pointer + "/packet",
                           name + " needs a periodic domain: it does not vanish at the ends",
                           "gaussian or eigenstate, re and im in x, or the boundary periodic");
    if (name == "periodic-gaussian") {
        const auto p = axisKeys(context, psi, axes, [&](const Domain& axis, bool) -> std::vector<Parameter> {
            return {{"kappa", 20, false, true}, {"centre", middleOf(axis)}, {"wave_number", 0}};
        });
        for (std::size_t i = 0; i < axes.size(); ++i)
            factors.push_back([kappa = p[3 * i], centre = p[3 * i + 1], k = p[3 * i + 2],
                               L = axes[i].length](double x) {
                return std::exp(-kappa * (1 - std::cos(twoPi / L * (x - centre)))) * std::polar(1.0, k * x);
            });
        return product(context, factors);
    }
    if (name == "plane-wave") {
        const auto k = axisKeys(context, psi, axes, [](const Domain&, bool isY) -> std::vector<Parameter> {
            return {{"wave_number", 0, !isY}};
        });
        std::vector<int> numbers;
        double phase = 0;
        for (std::size_t i = 0; i < axes.size(); ++i) {
            const std::string place = context.pointer + "/wave_number" + (i > 0 ? "_y" : "");
            const double turns = k[i] * axes[i].length / twoPi;
            const int n = i > 0 ? h.grid().ny : h.grid().nx;
            if (std::abs(turns - std::round(turns)) > 1e-9 * std::max(1.0, std::abs(turns)))
                throw InvalidScene(place,
                                   "does not fit into the domain: " + formatNumber(turns, 6) +
                                       " waves, got " + formatNumber(k[i]),
                                   "a multiple of 2 pi/length = " + formatNumber(twoPi / axes[i].length, 6));
            if (std::abs(turns) >= n / 2)
                throw InvalidScene(
                    place, "needs more than " + std::to_string(n) + " modes, got " + formatNumber(k[i]),
                    "more modes");
            numbers.push_back(static_cast<int>(std::lround(turns)));
            phase += k[i] * axes[i].left;
        }
        std::vector<Complex> c(static_cast<std::size_t>(h.size()));
        c[static_cast<std::size_t>(h.fourier().placeOf(numbers[0], numbers.size() > 1 ? numbers[1] : 0))] =
            std::sqrt(h.grid().measure()) * std::polar(1.0, phase);
        return c;
    }
    if (name == "eigenstate") return eigenstate(context, psi);
    if (name == "vortices") return fromNodes(context, vorticesOf(psi, context.pointer, h, context.constants));
    const std::vector<std::string> names = idsOf(packets());
    throw InvalidScene(context.pointer + "/packet", "unknown packet \"" + name + "\"",
                       suggestName(name, names));
}

std::vector<Complex> dispatch(const Context& context, const Value& psi) {
    if (!psi.isObject())
        throw InvalidScene(context.pointer, "must be an object",
                           "for example {\"packet\": \"gaussian\"} or {\"re\": \"exp(-(x - 3)^2)\"}");
    if (const Value* name = psi.find("packet")) {
        if (!name->isString())
            throw InvalidScene(context.pointer + "/packet", "must be the name of a packet");
        return packet(context, psi, name->asString());
    }
    if (const Value* values = psi.find("values")) {
        parametersOf(psi, context.pointer, {}, {"values"}, context.constants);
        if (!values->isObject())
            throw InvalidScene(context.pointer + "/values", "must be {\"re\": [..], \"im\": [..]}");
        return given(context, *values);
    }
    if (psi.find("re") || psi.find("im")) return expressions(context, psi);
    throw InvalidScene(context.pointer, "says nothing of the wave function",
                       "give re and im, a packet, or values");
}

}  // namespace

std::vector<CatalogItem> packets() {
    const auto key = [](const char* name, const char* title, const char* description) {
        FieldInfo field = numberField(name, title, "", 0, description);
        field.fallback = nullptr;
        return field;
    };
    const FieldInfo centre = key("centre", "centre", "The middle of the domain by default."),
                    width = key("width", "width", "A twentieth of the domain by default."),
                    wave =
                        numberField("wave_number", "wave number", "", 0, "Of the phase, per unit of length.");
    FieldInfo kappa = positive("kappa", "concentration", "", 20, "Large for narrow packets.");
    const std::string psi = "a wave function";
    std::vector<CatalogItem> all{{"gaussian",
                                  "Gaussian packet",
                                  "exp(-(x - centre)^2/(4 width^2) + i wave_number x).",
                                  {centre, width, wave},
                                  {},
                                  psi},
                                 {"periodic-gaussian",
                                  "periodic Gaussian packet",
                                  "exp(-kappa (1 - cos(x - centre)) + i wave_number x), on periodic domains.",
                                  {kappa, centre, wave},
                                  {},
                                  psi},
                                 {"eigenstate",
                                  "eigenstate",
                                  "Of a potential that does not depend on time.",
                                  {integerField("n", "n", 0, 1e6, 0.0, "Number of the state, from 0.")},
                                  {},
                                  psi},
                                 {"plane-wave",
                                  "plane wave of a wave function",
                                  "exp(i wave_number x), on periodic domains.",
                                  {wave},
                                  {},
                                  psi}};
    all.push_back(vortexPacket());
    for (CatalogItem& item : cloudPackets()) all.push_back(std::move(item));
    for (CatalogItem& item : solitonPackets()) all.push_back(std::move(item));
    return all;
}

std::vector<Complex> makePacket(const Value& psi, const std::string& pointer, bool isNormalised,
                                const std::shared_ptr<const Hamiltonian>& hamiltonian,
                                const Constants& constants, Coupling coupling) {
    if (auto cloud = cloudOf(psi, pointer, hamiltonian, coupling, constants)) return std::move(*cloud);
    std::vector<Complex> c = dispatch({pointer, hamiltonian, constants}, psi);
    const double norm = std::sqrt(squaredNorm(c.data(), static_cast<int>(c.size())));
    if (!(norm > 0)) throw InvalidScene(pointer, "is zero everywhere on the grid");
    if (isNormalised)
        for (Complex& v : c) v /= norm;
    return c;
}

std::vector<Complex> valuesAt(const Value& psi, const std::string& pointer,
                              const std::shared_ptr<const Hamiltonian>& hamiltonian,
                              const Constants& constants, const std::vector<double>& places) {
    const Context context{pointer, hamiltonian, constants};
    std::vector<Complex> values;
    if (const Value* const name = psi.find("packet")) {
        if (!name->isString() || name->asString() != "gaussian") return {};
        const Factor f = gaussians(context, psi).front();
        for (const double x : places) values.push_back(f(x));
    } else if (psi.find("re") || psi.find("im")) {
        const std::vector<Function> parts = expressionsOf(context, psi);
        for (const double x : places) values.emplace_back(parts[0].value(x, 0, 0), parts[1].value(x, 0, 0));
    }
    return values;
}

}  // namespace extremal::wave
