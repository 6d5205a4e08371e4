// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/density/density.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <span>

#include "engine/core/algebra/instruction_set.hpp"
#include "engine/core/problem.hpp"
#include "engine/core/text/invalid_text.hpp"
#include "engine/core/text/text.hpp"
#include "engine/model/typed/formula.hpp"
#include "engine/model/typed/tape/node_tape.hpp"
#include "engine/model/typed/symbolic.hpp"
#include "engine/model/typed/tape/tape_registers.hpp"

namespace extremal {
namespace {

using typed::Formula;
using typed::Graph;

constexpr const char* lagrangianKey = "lagrangian";
const char* const suffixes[] = {"", "_t", "_x", "_y"};

std::size_t triangle(std::size_t i, std::size_t j) {
    return i >= j ? i * (i + 1) / 2 + j : j * (j + 1) / 2 + i;
}

/// The names of all inputs. Throws where two are the same.
std::vector<std::string> inputNames(const std::vector<std::string>& components, int directions) {
    std::vector<std::string> names;
    for (int k = 0; k < 2 + directions; ++k)
        for (const std::string& name : components) names.push_back(name + suffixes[k]);
    for (const char* place : {"x", "y", "t"})
        if (directions > 1 || place[0] != 'y') names.emplace_back(place);
    for (std::size_t c = 0; c < components.size(); ++c)
        if (std::count(names.begin(), names.end(), components[c]) > 1)
            throw InvalidScene("/components/" + std::to_string(c),
                               "the name " + components[c] + " is that of a derivative", "another name");
    return names;
}

std::vector<std::pair<std::string, double>> parametersOf(const Settings& settings,
                                                         const std::vector<std::string>& taken) {
    std::vector<std::pair<std::string, double>> all;
    const Value* const given = settings.find("parameters");
    if (!given || !given->isObject()) return all;
    for (const auto& [name, value] : given->asObject()) {
        const std::string pointer = "/parameters/" + name, problem = nameProblem(name);
        if (!problem.empty()) throw InvalidScene(pointer, "the name \"" + name + "\" " + problem);
        if (std::find(taken.begin(), taken.end(), name) != taken.end())
            throw InvalidScene(pointer, "the name \"" + name + "\" has a meaning already", "another name");
        all.emplace_back(name, value.asNumber());
    }
    return all;
}

/// Names that formulas of mechanics know and densities do not.
void checkDensityNames(const std::string& text, const Formula& formula) {
    std::vector<std::string> known = formula.coordinates;
    for (const auto& [name, value] : formula.parameters) known.push_back(name);
    known.emplace_back("pi");
    for (const Expression::Node& node : parseExpression(text).nodes) {
        const bool isName = node.kind == Operator::name,
                   isVelocity = node.kind == Operator::call && node.name == "dot";
        if (isVelocity || (isName && std::find(known.begin(), known.end(), node.name) == known.end()))
            throw ExpressionError("has an unknown name \"" + node.name + "\"", node.position,
                                  "a density may use " + joinNames(known));
    }
}

/// The terms by the ends of their pointers, checked one by one, so that errors are shown where they are.
std::vector<std::pair<std::string, std::string>> termsOf(const Settings& settings) {
    const Value* const given = settings.find(lagrangianKey);
    std::vector<std::pair<std::string, std::string>> terms;
    if (given->isString()) terms.emplace_back("", given->asString());
    if (given->isObject())
        for (const auto& [name, text] : given->asObject()) terms.emplace_back("/" + name, text.asString());
    if (terms.empty())
        throw InvalidScene("/lagrangian", "must be a density, or an object of such terms by name",
                           "\"u_t^2/2 - u_x^2/2\"");
    return terms;
}

/// The formula of the sum. Throws InvalidScene.
Formula formulaOfDensity(const Settings& settings, std::vector<std::string> names,
                         std::vector<std::pair<std::string, double>> parameters) {
    Formula formula;
    formula.coordinates = std::move(names);
    formula.parameters = std::move(parameters);
    const auto terms = termsOf(settings);
    for (const auto& [name, text] : terms) {
        Formula term = formula;
        term.text = text;
        term.terms.clear();
        try {
            checkDensityNames(text, term);
            if (terms.size() > 1) (void)typed::differentiate(term);
        } catch (const ExpressionError& e) {
            throw invalidText("/lagrangian" + name, text, e, "the density ");
        }
    }
    for (const auto& [name, text] : terms)
        formula.text += terms.size() == 1 ? text : (formula.text.empty() ? "(" : " + (") + text + ")";
    formula.isExpanded = true;  // each term is one that may be typed
    return formula;
}

/// Here, with numbers in place of parameters, and 0 in place of the derivatives of components where wanted.
std::vector<int> adopted(Graph& graph, const typed::SymbolicLagrangian& from, const std::vector<int>& roots,
                         const Formula& formula, int firstZero = 0, int lastZero = 0) {
    return graph.adopt(from.graph, roots, [&](int symbol) -> std::optional<double> {
        if (symbol >= firstZero && symbol < lastZero) return 0.0;
        const int k = symbol - formula.firstParameter();
        if (k < 0) return {};
        return formula.parameters[static_cast<std::size_t>(k)].second;
    });
}

/// W = -L without derivatives, in the names of the components alone.
std::string potentialText(const Formula& formula, int components, int kinds) {
    std::string text = formula.text;
    for (int i = components; i < components * kinds; ++i)
        text = withNameReplaced(text, formula.coordinates[static_cast<std::size_t>(i)], "(0)");
    for (const auto& [name, value] : formula.parameters)
        text = withNameReplaced(text, name, "(" + formatNumber(value, 17) + ")");
    return "-(" + text + ")";
}

/// The second derivatives of a density as formulas, which tell what kind it is of.
class Recognition {
public:
    Recognition(const Formula& formula, int components, int arguments)
        : formula_(formula),
          m_(components),
          n_(arguments),
          symbolic_(typed::differentiate(formula)),
          second_(adopted(graph_, *symbolic_,
                          {symbolic_->hessian.begin(),
                           symbolic_->hessian.begin() + static_cast<std::ptrdiff_t>(n_ * (n_ + 1) / 2)},
                          formula)) {}

    /// What keeps it from being sum u_t^2/2 - c^2 |grad u|^2/2 - W(u); empty: nothing.
    std::string unusual() const {
        for (int i = m_; i < n_; ++i)
            for (int j = 0; j <= i; ++j) {
                const int kind = i / m_;
                const auto found = number(i, j), slope = number(slopeOf(i % m_), slopeOf(i % m_));
                const double wanted = i != j ? 0 : kind == DensityArgument::velocity ? 1 : slope.value_or(0);
                if (!found) return by(i, j) + "is not a number";
                if (*found != wanted)
                    return by(i, j) + "is " + formatNumber(*found, 6) + ", not " + formatNumber(wanted, 6);
                if (i == j && kind > DensityArgument::velocity && !(*found < 0))
                    return by(i, j) + "is not negative";
            }
        return {};
    }
    /// Of a usual one: the roots of -L_{u_x u_x}.
    std::vector<double> speeds() const {
        std::vector<double> all;
        for (int c = 0; c < m_; ++c) all.push_back(std::sqrt(-number(slopeOf(c), slopeOf(c)).value_or(0)));
        return all;
    }
    /// Where W is this number times |u|^2/2, but for what is linear.
    std::optional<double> squaredMass() const {
        const auto first = number(0, 0);
        if (!first || *first > 0) return {};
        for (int c = 0; c < m_; ++c)
            for (int d = 0; d <= c; ++d)
                if (number(c, d) != (c == d ? *first : 0)) return {};
        return -*first;
    }
    /// sine-gordon or phi4, where W' is the same formula and W the same at 0; else empty. Their equations are
    /// solved exactly, and faster.
    std::string namedPotential(double atRest) {
        if (m_ > 1) return {};
        const std::string u = formula_.coordinates[0];
        struct Known {
            const char* name;
            std::string text;
            double atRest;
        };
        for (const Known& known :
             {Known{"sine-gordon", "cos(" + u + ")-1", 0}, Known{"phi4", "-(" + u + "^2-1)^2/4", -0.25}}) {
            Formula reference = formula_;
            reference.text = known.text;
            const auto derived = typed::differentiate(reference);
            const int mine = adopted(graph_, *symbolic_, {symbolic_->gradient[0]}, formula_, m_, n_).front();
            const int theirs = adopted(graph_, *derived, {derived->gradient[0]}, reference).front();
            if (mine == theirs && std::abs(atRest - known.atRest) < 1e-15) return known.name;
        }
        return {};
    }

private:
    int slopeOf(int c) const { return DensityArgument::slopeX * m_ + c; }
    std::optional<double> number(int i, int j) const {
        const int node = second_[triangle(static_cast<std::size_t>(i), static_cast<std::size_t>(j))];
        if (!graph_.isNumber(node)) return {};
        return graph_.at(node).number;
    }
    std::string by(int i, int j) const {
        return "its second derivative by " + formula_.coordinates[static_cast<std::size_t>(i)] + " and " +
               formula_.coordinates[static_cast<std::size_t>(j)] + " ";
    }

    Formula formula_;
    int m_, n_;
    Graph graph_;
    std::shared_ptr<const typed::SymbolicLagrangian> symbolic_;
    std::vector<int> second_;
};

}  // namespace

FieldInfo densityField(const char* example) {
    FieldInfo f =
        termsField("lagrangian", "Lagrangian density", nullptr,
                   std::string("A density L in place of potential and wave speed: an expression in "
                               "the components, their derivatives (u_t, u_x), place, t and the "
                               "parameters, or an object of such terms by name, which are summed: ") +
                       example + ".");
    f.isOptional = true;
    return f;
}

FieldInfo densityParametersField() {
    FieldInfo f = constantsField("parameters", "Constants by name, for the Lagrangian density.");
    return f;
}

bool hasDensity(const Settings& model) {
    const Value* const given = model.find(lagrangianKey);
    return given && !given->isNull();
}

FieldDensity::FieldDensity(const Settings& settings, const std::vector<std::string>& components,
                           int directions)
    : components_(static_cast<int>(components.size())), directions_(directions) {
    const std::vector<std::string> names = inputNames(components, directions);
    parameters_ = parametersOf(settings, names);
    const Formula formula = formulaOfDensity(settings, names, parameters_);
    std::shared_ptr<const typed::SymbolicLagrangian> symbolic;
    try {
        symbolic = typed::differentiate(formula);
    } catch (const ExpressionError& e) {
        throw invalidText("/lagrangian", formula.text, e, "the density ");
    }
    const auto n = static_cast<std::size_t>(arguments());
    std::vector<int> roots{symbolic->value};
    roots.insert(roots.end(), symbolic->gradient.begin(),
                 symbolic->gradient.begin() + static_cast<std::ptrdiff_t>(n));
    roots.insert(roots.end(), symbolic->hessian.begin(),
                 symbolic->hessian.begin() + static_cast<std::ptrdiff_t>(n * (n + 1) / 2));
    Graph graph;
    const std::vector<int> here = adopted(graph, *symbolic, roots, formula);
    const std::span<const int> all(here);
    value_ = typed::Tape::of(graph, all.first(1), inputs());
    gradient_ = typed::Tape::of(graph, all.first(1 + n), inputs());
    jet_ = typed::Tape::of(graph, all, inputs());

    const auto depends = [&](std::size_t from, std::size_t count, int first, int last) {
        const std::vector<int> some(here.begin() + static_cast<std::ptrdiff_t>(from),
                                    here.begin() + static_cast<std::ptrdiff_t>(from + count));
        return graph.dependsOn(some, [&](int symbol) { return symbol >= first && symbol < last; });
    };
    const int places = arguments(), time = places + directions_;
    isTimeDependent_ = depends(0, 1 + n, time, time + 1);
    isMomentumTimeDependent_ = depends(1 + static_cast<std::size_t>(components_),
                                       static_cast<std::size_t>(components_), time, time + 1);
    for (int i = 0; i < directions_; ++i)
        dependsOnPlace_.push_back(depends(0, 1 + n, places + i, places + i + 1));
    for (int i = 0; i < places; ++i) dependsOn_.push_back(depends(0, 1, i, i + 1));
    for (int c = 0; c < components_; ++c) isCyclic_.push_back(!dependsOn(c));
    isLinear_ = !depends(1 + n, n * (n + 1) / 2, 0, places);
    recognise(formula.text, names);
    // p = dL/du_t is m(x, y) u_t, but for what does not move: it depends on no other argument.
    for (int c = components_; c < 2 * components_ && implicitBecause_.empty(); ++c) {
        const auto own = static_cast<std::size_t>(c);
        const std::size_t mass = 1 + n + triangle(own, own);
        const std::string by = "its derivative by " + names[own];
        if (depends(mass, 1, 0, places)) implicitBecause_ = by + " is not linear in it";
        for (int i = 0; i < places; ++i)
            if (i != c && depends(1 + own, 1, i, i + 1))
                implicitBecause_ = by + " depends on " + names[static_cast<std::size_t>(i)];
        if (depends(1 + own, 1, time, time + 1)) implicitBecause_ = by + " depends on t";
    }
}

void FieldDensity::recognise(const std::string& text, const std::vector<std::string>& names) {
    Formula formula;
    formula.coordinates = names;
    formula.parameters = parameters_;
    formula.text = text;
    formula.isExpanded = true;
    Recognition second(formula, components_, arguments());
    if (isTimeDependent_) unusual_ = "it depends on t";
    for (int i = 0; i < directions_; ++i)
        if (dependsOnPlace(i)) unusual_ = std::string("it depends on ") + (i == 0 ? "x" : "y");
    if (unusual_.empty()) unusual_ = second.unusual();
    if (!unusual_.empty()) return;
    // At u = 0 without derivatives: what is linear in them is not a part of W.
    std::vector<double> zero(static_cast<std::size_t>(inputs()), 0), slopes(zero.size());
    (void)gradient(zero.data(), slopes.data());
    for (int i = components_; i < arguments(); ++i)
        if (slopes[static_cast<std::size_t>(i)] != 0) {
            unusual_ = "it has a term linear in " + names[static_cast<std::size_t>(i)];
            return;
        }
    UsualDensity found;
    found.speeds = second.speeds();
    found.potential = potentialText(formula, components_, kinds());
    const bool isAtRest =
        std::all_of(slopes.begin(), slopes.begin() + components_, [](double s) { return s == 0; });
    const double rest = value(zero.data());
    if (const auto square = second.squaredMass(); square && isAtRest && rest == 0) {
        found.potential = *square == 0 ? "none" : "klein-gordon";
        found.mass = *square == 0 ? 1 : std::sqrt(*square);
    }
    if (const std::string name = second.namedPotential(rest); !name.empty()) found.potential = name;
    usual_ = std::move(found);
}

double FieldDensity::value(const double* at) const {
    const typed::TapeRegisters r(value_, [&](double* front) { std::copy_n(at, inputs(), front); });
    return r[0];
}

double FieldDensity::gradient(const double* at, double* slope) const {
    const typed::TapeRegisters r(gradient_, [&](double* front) { std::copy_n(at, inputs(), front); });
    const auto n = static_cast<std::size_t>(arguments());
    for (std::size_t i = 0; i < n; ++i) slope[i] = r[1 + i];
    return r[0];
}

namespace {

inline void gradientOfEight(const typed::Tape& tape, std::size_t arguments, std::size_t inputs,
                            const Lanes* at, Lanes* slope) {
    typed::runEight(
        tape, [&](Lanes* front) { std::copy_n(at, inputs, front); },
        [&](std::size_t k, const Lanes& value) {
            if (k > 0 && k <= arguments) slope[k - 1] = value;
        });
}

}  // namespace

void FieldDensity::gradient(const Lanes* at, Lanes* slope) const {
    static const auto run = ForThisMachine<&gradientOfEight>::call();
    run(gradient_, static_cast<std::size_t>(arguments()), static_cast<std::size_t>(inputs()), at, slope);
}

double FieldDensity::jet(const double* at, double* slope, double* curvature) const {
    const typed::TapeRegisters r(jet_, [&](double* front) { std::copy_n(at, inputs(), front); });
    const auto n = static_cast<std::size_t>(arguments());
    for (std::size_t i = 0; i < n; ++i) slope[i] = r[1 + i];
    for (std::size_t i = 0; i < n * (n + 1) / 2; ++i) curvature[i] = r[1 + n + i];
    return r[0];
}

Settings withPotential(const Settings& model, const UsualDensity& usual) {
    Settings plain = model;
    const bool isOne = std::all_of(usual.speeds.begin(), usual.speeds.end(),
                                   [&](double c) { return c == usual.speeds.front(); });
    for (auto& [key, value] : plain.keys) {
        if (key == lagrangianKey) value = Value();
        if (key == "parameters") value = Value(Value::Object{});
        if (key == "potential") value = Value(usual.potential);
        if (key == "mass") value = Value(usual.mass);
        if (key == "wave_speed") value = Value(usual.speeds.front());
        if (key == "wave_speeds" && !isOne) {
            Value::Array speeds;
            for (const double c : usual.speeds) speeds.emplace_back(c);
            value = Value(std::move(speeds));
        }
    }
    if (!isOne && !plain.find("wave_speeds")) {
        Value::Array speeds;
        for (const double c : usual.speeds) speeds.emplace_back(c);
        plain.keys.emplace_back("wave_speeds", Value(std::move(speeds)));
    }
    return plain;
}

}  // namespace extremal
