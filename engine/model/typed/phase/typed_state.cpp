// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/typed/phase/typed_state.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"
#include "engine/model/typed/typed_picture.hpp"
#include "engine/model/typed/typeset.hpp"

namespace extremal::typed {
namespace {

/// One number, or an expression in the parameters, for each variable: an array in their order, or an object
/// by name.
std::vector<double> startOf(const Settings& initial, const std::vector<std::string>& names,
                            const Constants& parameters) {
    const Value* const given = initial.find("x");
    const auto refuse = [&](const std::string& what) {
        throw InvalidScene("/x", what, "one number for each of " + joinNames(names));
    };
    std::vector<double> x;
    if (!given || given->isNull()) {  // 1, 0, 1, 0, ..
        for (std::size_t i = 0; i < names.size(); ++i) x.push_back(i % 2 == 0 ? 1 : 0);
    } else if (given->isArray()) {
        for (const Value& v : given->asArray())
            x.push_back(numberIn(v, "/x/" + std::to_string(x.size()), parameters));
    } else if (given->isObject()) {
        for (const std::string& name : names) {
            const Value* const v = given->find(name);
            if (!v) refuse("has no number for " + name);
            x.push_back(numberIn(*v, "/x/" + name, parameters));
        }
        if (given->asObject().size() != names.size()) refuse("has names that are not variables");
    }
    if (x.size() != names.size())
        refuse("must have " + std::to_string(names.size()) + " numbers, got " + std::to_string(x.size()));
    x.resize(names.size() + names.size() % 2);
    return x;
}

void describeErrors(System& s, const std::vector<std::string>& names) {
    const std::size_t m = names.size();
    s.error.columns.push_back({"error", "", "|x - x_ref|", ""});
    for (const std::string& name : names)
        s.error.columns.push_back({"error." + name, "", symbolOf(name) + " - ref", ""});
    s.error.evaluate = [m](const double* x, const double* reference, double* values) {
        double sum = 0;
        for (std::size_t i = 0; i < m; ++i) {
            values[1 + i] = x[i] - reference[i];
            sum += values[1 + i] * values[1 + i];
        }
        values[0] = std::sqrt(sum);
    };
}

}  // namespace

System systemOf(const std::string& id, const std::vector<std::string>& names, const Constants& parameters,
                const FirstOrder& equations) {
    System s;
    s.id = id;
    for (const std::string& name : names) s.columns.push_back({"x." + name, name, symbolOf(name), ""});
    s.start = [names, parameters](const Settings& initial, double) {
        return startOf(initial, names, parameters);
    };
    s.energy = [equations](double, const double* x) { return equations.energy(x, nullptr); };
    // Between rows, which hold what has a name.
    s.rate = [own = OwnFirstOrder(equations), n = names.size(),
              whole = std::vector<double>(static_cast<std::size_t>(equations.variables)),
              rate = std::vector<double>(static_cast<std::size_t>(equations.variables))](
                 double, const double* x, double* dx) mutable {
        std::copy_n(x, n, whole.begin());
        const bool isKnown = own->rate(whole.data(), rate.data());
        std::copy_n(rate.begin(), n, dx);
        return isKnown;
    };
    s.frequency = [equations](double, const double* x) { return fastestOf(equations, x); };
    s.blocks = {0, {static_cast<std::size_t>(equations.variables)}};
    describeErrors(s, names);
    Formula formula;
    formula.coordinates = names;
    const Picture picture = pictureOf(formula);
    s.draw = picture.draw;
    s.isSpatial = picture.isSpatial;
    s.hasPlanarTrajectory = picture.planeX == 0 && picture.planeY == 1;
    s.phaseX = s.trajectoryX = "x." + names[0];
    s.phaseY = s.trajectoryY = "x." + names[std::min<std::size_t>(1, names.size() - 1)];
    return s;
}

void checkEnergy(const FirstOrder& equations, const State& at) {
    std::vector<double> gradient(at.x.size());
    const double value = equations.energy(at.x.data(), gradient.data());
    if (!std::isfinite(value) ||
        !std::all_of(gradient.begin(), gradient.end(), [](double v) { return std::isfinite(v); }))
        throw InvalidScene("/hamiltonian",
                           "is not finite, or has no finite derivatives, at the initial data");
}

FieldInfo hamiltonianField(const char* example) {
    return termsField("hamiltonian", "Hamiltonian", example,
                      "H as an expression in variables and parameters, or an object of such terms by name.");
}

FieldInfo startField() {
    return optionalJsonField(
        "x", "start",
        "One number, or expression in the parameters, per variable: an array, or an object by name.");
}

}  // namespace extremal::typed
