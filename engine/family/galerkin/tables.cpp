// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/family/galerkin/tables.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "engine/core/algebra/dense.hpp"
#include "engine/core/problem.hpp"
#include "engine/core/work.hpp"
#include "engine/family/rule_choices.hpp"
#include "engine/integrator/oscillator_step.hpp"
#include "engine/quadrature/catalog.hpp"
#include "engine/space/typed.hpp"
#include "engine/tableau/tableau.hpp"

namespace extremal::galerkin {
namespace {

constexpr int mostNodes = 96;
constexpr double exactTo = 4e-14;

template <class T>
std::vector<T> panelEnds(const std::vector<double>& cells, int partsOfCell) {
    std::vector<T> ends{T(0)};
    for (std::size_t j = 1; j < cells.size(); ++j)
        for (int k = 1; k <= partsOfCell; ++k)
            ends.push_back(k == partsOfCell
                               ? T(cells[j])
                               : T(cells[j - 1]) + (T(cells[j]) - T(cells[j - 1])) * T(k) / T(partsOfCell));
    return ends;
}

/// What a rule makes of int phi_a' phi_b', and of int (phi_a phi_b)' = phi_a(1) phi_b(1), all a and b.
struct Products {
    std::vector<Quad> energy, end;

    Products(const Space<double>& space, const Rule<double>& rule)
        : energy(static_cast<std::size_t>(space.size * space.size), Quad(0)), end(energy) {
        const auto n = static_cast<std::size_t>(space.size);
        std::vector<__float128> value(n), slope(n);
        for (std::size_t i = 0; i < rule.c.size(); ++i) {
            space.evaluateQuadruple(rule.c[i], value, slope);
            work::spend(4 * work::quadruple * static_cast<double>(n * n));
            for (std::size_t a = 1; a < n; ++a)
                for (std::size_t b = 1; b <= a; ++b) {
                    energy[a * n + b] += Quad(rule.b[i]) * Quad(slope[a]) * Quad(slope[b]);
                    end[a * n + b] +=
                        Quad(rule.b[i]) * (Quad(slope[a]) * Quad(value[b]) + Quad(value[a]) * Quad(slope[b]));
                }
        }
    }
};

/// Largest error of a rule for phi_a' phi_b', which are orthonormal but for the last, and for (phi_a phi_b)'.
double defectOf(const Space<double>& space, const Rule<double>& rule) {
    const auto n = static_cast<std::size_t>(space.size);
    const Products found(space, rule);
    Quad worst(0);
    for (std::size_t a = 1; a < n; ++a)
        for (std::size_t b = 1; b <= a; ++b) {
            const bool isLast = a + 1 == n && b + 1 == n;
            if (!isLast) worst = std::max(worst, Quad(abs(found.energy[a * n + b] - (a == b ? 1 : 0))));
            worst = std::max(worst, Quad(abs(found.end[a * n + b] - (isLast ? 1 : 0))));
        }
    return static_cast<double>(worst);
}

/// Whether a rule errs by far more than round-off in double precision, for the same products: most rules that
/// are too small are told so at a hundredth of the cost.
bool isFarOff(const Space<double>& space, const Rule<double>& rule) {
    constexpr double far = 1e-7;
    const auto n = static_cast<std::size_t>(space.size);
    std::vector<double> value(n), slope(n), energy(n * n, 0), end(n * n, 0);
    work::spend(4.0 * static_cast<double>(n * n * rule.c.size()));
    for (std::size_t i = 0; i < rule.c.size(); ++i) {
        space.evaluate(rule.c[i], value, slope);
        for (std::size_t a = 1; a < n; ++a)
            for (std::size_t b = 1; b <= a; ++b) {
                energy[a * n + b] += rule.b[i] * slope[a] * slope[b];
                end[a * n + b] += rule.b[i] * (slope[a] * value[b] + value[a] * slope[b]);
            }
    }
    for (std::size_t a = 1; a < n; ++a)
        for (std::size_t b = 1; b <= a; ++b) {
            const bool isLast = a + 1 == n && b + 1 == n;
            if (!isLast && std::abs(energy[a * n + b] - (a == b ? 1 : 0)) > far) return true;
            if (std::abs(end[a * n + b] - (isLast ? 1 : 0)) > far) return true;
        }
    return false;
}

/// Panels that become narrower towards the places where the functions are hard to integrate, a power at an
/// end or a pole beyond it: the panel with the largest error is divided, where that helps most.
class GradedPanels {
public:
    explicit GradedPanels(const Space<double>& space) : space_(space), rule_(gauss<double>(perPanel)) {}

    /// 0, ..., 1, the ends of `cells` among them; empty where they would be too many.
    std::vector<double> ends(const std::vector<double>& cells) {
        std::vector<Panel> panels;
        for (std::size_t j = 1; j < cells.size(); ++j) panels.push_back(panel(cells[j - 1], cells[j]));
        while (static_cast<int>(panels.size()) <= mostPanels) {
            double sum = 0;
            std::size_t worst = 0;
            for (std::size_t j = 0; j < panels.size(); ++j) {
                sum += panels[j].error;
                if (panels[j].error > panels[worst].error) worst = j;
            }
            if (sum <= exactTo) {
                std::vector<double> all{0};
                for (const Panel& p : panels) all.push_back(p.b);
                return all;
            }
            divide(panels, worst);
        }
        return {};
    }

    static constexpr int perPanel = 12, mostPanels = 16;

private:
    struct Panel {
        double a, b, error;
    };

    std::vector<Quad> integrals(double a, double b) const {
        Rule<double> on = rule_;
        for (double& c : on.c) c = a + (b - a) * c;
        for (double& w : on.b) w *= b - a;
        Products found(space_, on);
        found.energy.insert(found.energy.end(), found.end.begin(), found.end.end());
        return found.energy;
    }

    /// Its error is measured against that of its halves, off the middle.
    Panel panel(double a, double b) const {
        const double middle = a + 0.4871 * (b - a);
        const std::vector<Quad> whole = integrals(a, b), left = integrals(a, middle),
                                right = integrals(middle, b);
        Quad worst(0);
        for (std::size_t k = 0; k < whole.size(); ++k)
            worst = std::max(worst, Quad(abs(whole[k] - left[k] - right[k])));
        return {a, b, static_cast<double>(worst)};
    }

    void divide(std::vector<Panel>& panels, std::size_t j) const {
        const Panel whole = panels[j];
        std::pair<Panel, Panel> best;
        double least = std::numeric_limits<double>::infinity();
        for (const double share : {0.5, 0.25, 0.75}) {
            const double at = whole.a + share * (whole.b - whole.a);
            const std::pair<Panel, Panel> parts{panel(whole.a, at), panel(at, whole.b)};
            const double error = parts.first.error + parts.second.error;
            if (error >= least) continue;
            least = error;
            best = parts;
        }
        panels[j] = best.second;
        panels.insert(panels.begin() + static_cast<std::ptrdiff_t>(j), best.first);
    }

    const Space<double>& space_;
    Rule<double> rule_;
};

/// T: that of the result; whether the nodes are enough is decided in double precision.
template <class T>
Rule<T> automaticRule(const Space<double>& space) {
    const std::vector<double> cells = space.cells.empty() ? std::vector<double>{0, 1} : space.cells;
    const int fewest = std::max(1, (space.size - 1) / (static_cast<int>(cells.size()) - 1));
    for (int nodes = std::max(1, fewest / 2); nodes <= mostNodes; ++nodes) {
        const Rule<double> rule = composite(gauss<double>(nodes), panelEnds<double>(cells, 1));
        if (!isFarOff(space, rule) && defectOf(space, rule) <= exactTo)
            return cells.size() == 2 ? gauss<T>(nodes) : composite(gauss<T>(nodes), panelEnds<T>(cells, 1));
    }
    if (const std::vector<double> ends = GradedPanels(space).ends(cells); !ends.empty())
        return composite(gauss<T>(GradedPanels::perPanel), std::vector<T>(ends.begin(), ends.end()));
    throw InvalidScene("/quadrature",
                       "no Gauss rule with at most " + std::to_string(mostNodes) +
                           " nodes per cell, nor one with " + std::to_string(GradedPanels::perPanel) +
                           " in each of " + std::to_string(GradedPanels::mostPanels) +
                           " panels, integrates the products of the functions to round-off",
                       "a rule of your choice, such as gauss with 12 nodes; or a smaller step, or knots");
}

}  // namespace

int cellsIn(const Settings& space) {
    if (const Value* knots = space.find("knots"); knots && knots->isArray())
        return static_cast<int>(knots->asArray().size()) + 1;
    return std::max(1, space.integer("cells"));
}

Settings completedRule(const Settings& space, const Settings& quadrature) {
    if (const Value* otherwise = space.find("otherwise")) {
        // Panels follow from the coordinates that a term sees.
        int degree = 1;
        const auto raise = [&](const Value& own) {
            if (const Value* given = own.find("degree"); given && given->isNumber())
                degree = std::max(degree, static_cast<int>(given->asNumber()));
        };
        raise(*otherwise);
        if (const Value* variables = space.find("variables"); variables && variables->isObject())
            for (const auto& [name, own] : variables->asObject()) raise(own);
        Settings complete = completePlainRule(quadrature, degree, 1);
        if (!quadrature.find("panels"))
            for (auto& [key, value] : complete.keys)
                if (key == "panels") value = Value();
        return complete;
    }
    const Value* const functions = space.find("functions");
    if (!functions) return completePlainRule(quadrature, space.integer("degree"), cellsIn(space));
    if (quadrature.type.empty() || quadrature.type == "auto") return {"auto", {}, {}};
    const int dimension = functions->isArray() ? static_cast<int>(functions->asArray().size()) : 2;
    return completePlainRule(quadrature, std::max(1, dimension - 1), cellsIn(space));
}

template <class T>
Rule<T> ruleOn(const Space<double>& space, const Settings& quadrature) {
    if (quadrature.type == "auto") return automaticRule<T>(space);
    const int panels = std::max(1, quadrature.integer("panels"));
    const int cells = static_cast<int>(space.cells.size()) - 1;
    if (cells < 2 || panels % cells != 0) return makeRule<T>(quadrature);
    Settings onePanel = quadrature;
    for (auto& [key, value] : onePanel.keys)
        if (key == "panels") value = 1.0;
    return composite(makeRule<T>(onePanel), panelEnds<T>(space.cells, panels / cells));
}
template Rule<double> ruleOn(const Space<double>&, const Settings&);

Table<double> makeTable(const Settings& settings, const Settings& quadrature) {
    const Space<double> space = makeSpace(settings);
    Table<double> table = extremal::makeTable(space, ruleOn<double>(space, quadrature));
    table.dependsOnStep = dependsOnStep(settings);
    return table;
}

std::shared_ptr<const Tableau> tableauOf(const Settings& settings, const Settings& quadrature) {
    const Space<double> space = makeSpace(settings);
    return std::make_shared<const Tableau>(
        galerkinTableau(makeQuadrupleTable(space, ruleOn<Quad>(space, quadrature))));
}

/// Rows and columns in the order start, inside, end: the function of the start is the last test function.
OscillatorStep oscillatorOf(const Settings& settings, const Settings& quadrature) {
    const Space<double> space = makeSpace(settings);
    const Table<Quad> t = makeQuadrupleTable(space, ruleOn<Quad>(space, quadrature));
    const Eigen::Index m = t.unknowns();
    OscillatorStep::Matrix value(t.nodes(), m + 1), slope(t.nodes(), m + 1);
    value << t.testValue.col(m - 1), t.value;
    slope << t.testDerivative.col(m - 1), t.derivative;
    const auto size = static_cast<double>(m);
    work::spend(2 * work::quadruple * size * size * t.nodes());
    const auto summed = [&](const OscillatorStep::Matrix& f) {
        const OscillatorStep::Matrix weighted = f.transpose() * t.weight.asDiagonal();
        return dense::product<Quad>(weighted, f);
    };
    return {summed(slope), summed(value)};
}

}  // namespace extremal::galerkin
