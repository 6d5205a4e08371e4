#include "engine/wave/packet.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "engine/core/problem.hpp"
#include "engine/core/text.hpp"
#include "engine/wave/eigen.hpp"

namespace extremal::wave {
namespace {

constexpr double twoPi = 2 * std::numbers::pi;

struct Context {
    const std::string& pointer;
    const std::shared_ptr<const Hamiltonian>& hamiltonian;
    const Constants& constants;
    const Domain& domain() const { return hamiltonian->domain(); }
};

std::vector<Complex> fromNodes(const Context& context, const std::vector<Complex>& psi) {
    for (std::size_t j = 0; j < psi.size(); ++j)
        if (!std::isfinite(psi[j].real()) || !std::isfinite(psi[j].imag()))
            throw InvalidScene(context.pointer, "is not finite at x = " + formatNumber(context.hamiltonian->x()[j], 6));
    std::vector<Complex> c(psi.size());
    context.hamiltonian->toCoefficients(psi.data(), c.data());
    return c;
}

std::vector<Complex> sampled(const Context& context, const std::function<Complex(double x)>& psi) {
    std::vector<Complex> values;
    for (const double x : context.hamiltonian->x()) values.push_back(psi(x));
    return fromNodes(context, values);
}

std::vector<Complex> expressions(const Context& context, const Value& psi) {
    std::vector<Function> parts;
    for (const char* key : {"re", "im"}) {
        const Value* text = psi.find(key);
        const std::string place = context.pointer + "/" + key;
        if (!text) {
            parts.push_back({[](double, double) { return 0.0; }, false});
        } else if (text->isNumber()) {
            parts.push_back({[v = text->asNumber()](double, double) { return v; }, false});
        } else if (text->isString()) {
            parts.push_back(functionOf(text->asString(), place, context.constants, false));
        } else {
            throw InvalidScene(place, "must be an expression in x");
        }
    }
    parametersOf(psi, context.pointer, {}, {"re", "im"}, context.constants);
    return sampled(context, [&](double x) { return Complex(parts[0].value(x, 0), parts[1].value(x, 0)); });
}

std::vector<Complex> given(const Context& context, const Value& values) {
    const auto n = static_cast<std::size_t>(context.hamiltonian->size());
    std::vector<Complex> psi(n);
    for (const char* key : {"re", "im"}) {
        const Value* numbers = values.find(key);
        const std::string place = context.pointer + "/values/" + key;
        if (!numbers && std::string_view(key) == "im") continue;
        if (!numbers || !numbers->isArray() || numbers->asArray().size() != n)
            throw InvalidScene(place, "must have " + std::to_string(n) + " numbers, one per node" +
                                          (numbers && numbers->isArray()
                                               ? ", got " + std::to_string(numbers->asArray().size())
                                               : std::string()),
                               "the number of nodes is /model/modes");
        for (std::size_t j = 0; j < n; ++j) {
            const double v = numberOf(numbers->asArray()[j], place + "/" + std::to_string(j), context.constants);
            psi[j] += std::string_view(key) == "re" ? Complex(v, 0) : Complex(0, v);
        }
    }
    return fromNodes(context, psi);
}

std::vector<Complex> eigenstate(const Context& context, const Value& psi) {
    const double n = parametersOf(psi, context.pointer, {{"n", 0}}, {"packet"}, context.constants)[0];
    const Hamiltonian& h = *context.hamiltonian;
    if (h.isTimeDependent())
        throw InvalidScene(context.pointer, "has no eigenstate: the potential depends on t", "another packet");
    const int limit = std::min(h.size(), Eigenstates::denseLimit);
    if (!(n >= 0 && n < limit / 2 && n == std::floor(n)))
        throw InvalidScene(context.pointer + "/n",
                           "must be a whole number from 0 to " + std::to_string(limit / 2 - 1) + ", got " + formatNumber(n));
    if (h.size() <= limit) return Eigenstates::of(context.hamiltonian)->coefficients(static_cast<int>(n));
    // From the finest grid that is small enough, if the state is resolved there: then more modes do not change it.
    const auto coarse = h.withModes(limit);
    const std::vector<Complex> found = Eigenstates::of(coarse)->coefficients(static_cast<int>(n));
    const auto size = static_cast<std::size_t>(h.size());
    std::vector<Complex> c(size), Hc(size), work(size);
    for (int i = 0; i < limit; ++i) {
        const int a = coarse->fourier().number(i);
        c[static_cast<std::size_t>(a >= 0 ? a : h.size() + a)] = found[static_cast<std::size_t>(i)];
    }
    h.apply(h.potential().data(), c.data(), Hc.data(), work.data());
    const double E = innerProduct(c.data(), Hc.data(), h.size()).real();
    double residual = 0;
    for (std::size_t i = 0; i < size; ++i) residual += std::norm(Hc[i] - E * c[i]);
    if (std::sqrt(residual) > 1e-6 * (1 + std::abs(E)))
        throw InvalidScene(context.pointer, "state " + formatNumber(n) + " is not resolved by " + std::to_string(limit) +
                                                " modes, up to which eigenstates are computed", "another packet");
    return c;
}

std::vector<Complex> packet(const Context& context, const Value& psi, const std::string& name) {
    const Domain& domain = context.domain();
    const double middle = domain.left + domain.length / 2, L = domain.length;
    const auto read = [&](const std::vector<Parameter>& parameters) {
        return parametersOf(psi, context.pointer, parameters, {"packet"}, context.constants);
    };
    if (name == "gaussian") {
        const auto p = read({{"centre", middle}, {"width", L / 20, false, true}, {"wave_number", 0}});
        const double period = context.hamiltonian->isPeriodic() ? L : 0;
        return sampled(context, [p, L, period](double x) {
            const double d = x - p[0] - period * std::round((x - p[0]) / L);
            return std::exp(-d * d / (4 * p[1] * p[1])) * std::polar(1.0, p[2] * (p[0] + d));
        });
    }
    if (!context.hamiltonian->isPeriodic() && (name == "periodic-gaussian" || name == "plane-wave"))
        throw InvalidScene(context.pointer + "/packet", name + " needs a periodic domain: it does not vanish at the walls",
                           "gaussian or eigenstate, re and im in x, or the boundary periodic");
    if (name == "periodic-gaussian") {
        const auto p = read({{"kappa", 20, false, true}, {"centre", middle}, {"wave_number", 0}});
        return sampled(context, [p, L](double x) {
            return std::exp(-p[0] * (1 - std::cos(twoPi / L * (x - p[1])))) * std::polar(1.0, p[2] * x);
        });
    }
    if (name == "plane-wave") {
        const double k = read({{"wave_number", 0, true}})[0], turns = k * L / twoPi;
        const int n = context.hamiltonian->size();
        if (std::abs(turns - std::round(turns)) > 1e-9 * std::max(1.0, std::abs(turns)))
            throw InvalidScene(context.pointer + "/wave_number",
                               "does not fit into the domain: " + formatNumber(turns, 6) + " waves, got " + formatNumber(k),
                               "a multiple of 2 pi/length = " + formatNumber(twoPi / L, 6));
        if (std::abs(turns) >= n / 2)
            throw InvalidScene(context.pointer + "/wave_number", "needs more than " + std::to_string(n) + " modes, got " +
                                                                     formatNumber(k), "more modes");
        std::vector<Complex> c(static_cast<std::size_t>(n));
        const int a = static_cast<int>(std::lround(turns));
        c[static_cast<std::size_t>(a >= 0 ? a : n + a)] = std::sqrt(L) * std::polar(1.0, k * domain.left);
        return c;
    }
    if (name == "eigenstate") return eigenstate(context, psi);
    const std::vector<std::string> names{"gaussian", "periodic-gaussian", "eigenstate", "plane-wave"};
    throw InvalidScene(context.pointer + "/packet", "unknown packet \"" + name + "\"", suggestName(name, names));
}

std::vector<Complex> dispatch(const Context& context, const Value& psi) {
    if (!psi.isObject())
        throw InvalidScene(context.pointer, "must be an object",
                           "for example {\"packet\": \"gaussian\"} or {\"re\": \"exp(-(x - 3)^2)\"}");
    if (const Value* name = psi.find("packet")) {
        if (!name->isString()) throw InvalidScene(context.pointer + "/packet", "must be the name of a packet");
        return packet(context, psi, name->asString());
    }
    if (const Value* values = psi.find("values")) {
        parametersOf(psi, context.pointer, {}, {"values"}, context.constants);
        if (!values->isObject()) throw InvalidScene(context.pointer + "/values", "must be {\"re\": [..], \"im\": [..]}");
        return given(context, *values);
    }
    if (psi.find("re") || psi.find("im")) return expressions(context, psi);
    throw InvalidScene(context.pointer, "says nothing of the wave function", "give re and im, a packet, or values");
}

}  // namespace

std::vector<Complex> makePacket(const Value& psi, const std::string& pointer, bool isNormalised,
                                const std::shared_ptr<const Hamiltonian>& hamiltonian, const Constants& constants) {
    std::vector<Complex> c = dispatch({pointer, hamiltonian, constants}, psi);
    const double norm = std::sqrt(squaredNorm(c.data(), static_cast<int>(c.size())));
    if (!(norm > 0)) throw InvalidScene(pointer, "is zero everywhere on the grid");
    if (isNormalised)
        for (Complex& v : c) v /= norm;
    return c;
}

}  // namespace extremal::wave
