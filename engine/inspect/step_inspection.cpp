// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/inspect/step_inspection.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"
#include "engine/family/table_of.hpp"
#include "engine/figure/build.hpp"
#include "engine/model/typed/symbolic.hpp"
#include "engine/model/typed/typeset.hpp"
#include "engine/passport/passport.hpp"
#include "engine/passport/scene_formula.hpp"
#include "engine/passport/scheme_tableau.hpp"
#include "engine/quadrature/tensor.hpp"
#include "engine/run/kkt_pattern.hpp"
#include "engine/scene/view_choices.hpp"
#include "engine/space/typed.hpp"
#include "engine/study/stability/linear_stability.hpp"
#include "engine/view/catalog.hpp"

namespace extremal {
namespace {

/// The nodes of the rule of a step, as shares of it, and their weights; none where there is no one rule.
struct Nodes {
    std::vector<double> place, weight;
};

/// L and the Euler-Lagrange equations as they are written; as it was typed where they would fill pages.
std::vector<WrittenFormula> equationsOf(const typed::Formula& formula) {
    constexpr std::size_t longest = 1000;
    const auto symbolic = typed::differentiate(formula);
    const auto plain = typed::TextForm::plain;
    std::string text = typed::typeset(symbolic->graph, symbolic->value, formula, plain);
    if (text.size() > longest) text = formula.text;
    std::vector<WrittenFormula> lines{{"L = " + text, {}}};
    for (const std::string& line : typed::equationLines(formula, plain)) lines.push_back({line, {}});
    return lines;
}

class Inspection {
public:
    Inspection(const ResolvedScene& scene, std::size_t place, const State& from)
        : scene_(scene),
          spec_(scene.schemes[place]),
          place_(place),
          system_(systemOf(scene, spec_)),
          result_{from, {}, {}, {}} {}

    StepInspection make(const std::stop_token& stop) {
        takeStep();
        nodes_ = nodes();
        addMotion();
        addEquations();
        addIteration(stop);
        if (!stop.stop_requested()) addAmplification(stop);
        addPage();
        return std::move(result_);
    }

private:
    std::unique_ptr<Integrator> integrator(const ResolvedScheme& scheme) const {
        return scheme.make(*system_, scheme.spec.step.value, result_.from);
    }
    StepReport advance(Integrator& integrator, State& state) const {
        state = result_.from;
        state.node = 0;
        if (integrator.grid() == TimeGrid::fixed) return extremal::advance(integrator, state);
        return integrator.advance(state, scene_.scene.end.value);
    }

    void takeStep() {
        integrator_ = integrator(spec_);
        result_.report = advance(*integrator_, after_);
    }
    bool isDone() const { return result_.report.outcome == Outcome::converged; }
    double length() const { return after_.t - result_.from.t; }

    Nodes nodes() const {
        Nodes nodes;
        if (!system_->isMovedOnlyBy<Mechanical>()) return nodes;
        if (const Discretization* const d = spec_.plain()) {
            const bool isFitted = !isTermRule(d->quadrature) && dependsOnStep(d->space);
            if (!hasTable(*d) && !isFitted) return nodes;
            const Table<double> table = tableOf(withStep(d->space, spec_.spec.step.value), d->quadrature);
            nodes.place.assign(table.node.begin(), table.node.end());
            nodes.weight.assign(table.weight.begin(), table.weight.end());
            return nodes;
        }
        std::string reason;
        if (const auto tableau = tableauOf(scene_, spec_, reason)) {
            for (const auto& c : tableau->cHat) nodes.place.push_back(static_cast<double>(c));
            for (const auto& b : tableau->bHat) nodes.weight.push_back(static_cast<double>(b));
        }
        return nodes;
    }

    /// Figures of this scheme alone.
    FigureContext context(const View& view) const {
        return {comparison_, view, system_.get(), *findView(view.id)};
    }
    Series series(SeriesKind kind, Tone tone = Tone::full) const {
        Series s;
        s.label = spec_.spec.label;
        s.style = styleOf(spec_.spec, place_);
        s.kind = kind;
        s.tone = tone;
        return s;
    }
    void finish(Figure figure, const View& view, const std::string& what) {
        finishFigure(figure, context(view), what);
        figure.drop<FailureMark>();
        figure.view += "-of-step";
        if (!isEmpty(figure)) result_.figures.push_back(std::move(figure));
    }

    /// The scheme's own curve of every coordinate, at most three, and its nodes on it.
    void addMotion() {
        comparison_.scene = scene_.scene;
        comparison_.system = system_;
        comparison_.isFinished = true;
        if (!isDone() || !system_->hasCoordinates()) return;
        const int points = 200 + static_cast<int>(std::min(2000.0, 40 * integrator_->periodsPerStep()));
        std::vector<double> x(after_.x.size());
        for (std::size_t k = 0; k < std::min<std::size_t>(3, system_->coordinates.size()); ++k) {
            const Coordinate& q = system_->coordinates[k];
            View view{"trajectory", "", "q." + q.name};
            Figure figure = startFigure(context(view), "Step of " + spec_.spec.label + ": " + q.title);
            figure.x.title = axisTitle(system_->independent, system_->timeUnit);
            figure.y.title = axisTitle(q.symbol, q.unit);
            Series curve = series(SeriesKind::line), marks = series(SeriesKind::marks);
            const auto add = [&](Series& s, double tau) {
                integrator_->denseOutput(tau, x);
                s.x.push_back(result_.from.t + tau * length());
                s.y.push_back(x[k]);
            };
            for (int i = 0; i <= points; ++i) add(curve, static_cast<double>(i) / points);
            for (const double c : nodes_.place)
                if (c >= 0 && c <= 1) add(marks, c);
            marks.part = "nodes";
            figure.subtitle =
                std::to_string(nodes_.place.size()) + (nodes_.place.size() == 1 ? " node" : " nodes");
            // Each weight above its node.
            const auto [low, high] = std::minmax_element(curve.y.begin(), curve.y.end());
            const double above = *high > *low ? 0.08 * (*high - *low) : 0.08;
            if (marks.x.size() == nodes_.place.size() && marks.x.size() <= 9)
                for (std::size_t i = 0; i < marks.x.size(); ++i)
                    figure.add(Label{marks.x[i], marks.y[i] + above, shortNumber(nodes_.weight[i], 3)});
            figure.add(std::move(curve));
            if (!marks.x.empty()) figure.add(std::move(marks));
            finish(std::move(figure), view, "Motion in one step");
        }
    }

    /// What the views of the functions and of the KKT matrix show of this scheme, at this state.
    void addEquations() {
        auto shown = std::make_shared<SchemeResult>();
        shown->spec = spec_.spec;
        shown->spec.isEnabled = true;
        shown->scheme = std::make_shared<const ResolvedScheme>(spec_);
        shown->style = styleOf(spec_.spec, place_);
        shown->summary.status = RunStatus::done;
        if (const View matrix{"sparsity", "", ""};
            missingFor(matrix, *system_).empty() && unsuitableFor(*findView(matrix.id), spec_).empty())
            shown->products.make<KktPattern>() =
                kktPattern(*system_, withEstimates(*spec_.plain(), *system_, result_.from), result_.from,
                           spec_.spec.step.value);
        comparison_.schemes = {shown};
        for (const char* id : {"basis", "sparsity"}) {
            View view;
            view.id = id;
            if (!missingFor(view, *system_).empty()) continue;
            Figure figure = makeFigure(comparison_, view, system_.get());
            if (!isEmpty(figure)) result_.figures.push_back(std::move(figure));
        }
    }

    /// How far the step is from the one with the smallest tolerance, against the iterations that it took.
    void addIteration(const std::stop_token& stop) {
        if (!isDone() || result_.report.cost.iterations == 0 || !spec_.family) return;
        struct Try {
            long long iterations;
            std::vector<double> x;
        };
        std::vector<Try> tries;
        for (int digits = 1; digits <= 15 && !stop.stop_requested(); ++digits) {
            ResolvedScheme scheme = spec_;
            Value::Object& solver = scheme.discretization.solver.keys;
            std::erase_if(solver, [](const auto& member) { return member.first == "tolerance"; });
            solver.emplace_back("tolerance", std::pow(10.0, -digits));
            State state;
            try {
                const auto looser = integrator(scheme);
                const StepReport report = advance(*looser, state);
                if (report.outcome != Outcome::converged) continue;
                if (tries.empty() || report.cost.iterations > tries.back().iterations)
                    tries.push_back({report.cost.iterations, state.x});
            } catch (const InvalidScene&) {
                return;  // the scheme has no such tolerance
            }
        }
        if (tries.size() < 2) return;
        View view{"error", "", ""};
        Figure figure = startFigure(context(view), "Iteration for the step of " + spec_.spec.label);
        figure.x.title = "iterations";
        figure.y = logAxis("|x - x_last|");
        Series s = series(SeriesKind::markedLine);
        for (std::size_t i = 0; i + 1 < tries.size(); ++i) {
            double distance = 0;
            for (std::size_t k = 0; k < tries[i].x.size(); ++k)
                distance = std::max(distance, std::fabs(tries[i].x[k] - tries.back().x[k]));
            s.x.push_back(static_cast<double>(tries[i].iterations));
            s.y.push_back(distance);
        }
        figure.add(std::move(s));
        figure.subtitle = "distance from the step with " + std::to_string(tries.back().iterations) +
                          " iterations, for looser tolerances";
        finish(std::move(figure), view, "Convergence of the iteration");
    }

    /// The largest eigenvalue of the step on the test equation.
    void addAmplification(const std::stop_token& stop) {
        if (linearTestOf(*system_) != LinearTest::oscillator) return;
        const LinearStability stability = linearStability(scene_.scene, place_, stop);
        if (stability.points.empty()) return;
        View view{"error", "", ""};
        Figure figure = startFigure(context(view), "Stability of " + spec_.spec.label);
        figure.x.title = "hω";
        figure.y.title = "max |r|";
        Series s = series(SeriesKind::line);
        for (const LinearStability::Point& p : stability.points) {
            s.x.push_back(p.z);
            s.y.push_back(std::min(p.amplification, 10.0));
        }
        figure.add(Guide{{0, s.x.back()}, {1, 1}, true});
        figure.add(std::move(s));
        figure.subtitle = stability.hasLimit && stability.low > 0
                              ? "on the oscillator, stable up to hω = " + shortNumber(stability.limit(), 4)
                          : stability.hasLimit ? "on the oscillator, unstable for every step"
                                               : "on the oscillator, stable as far as was looked";
        finish(std::move(figure), view, "Amplification by one step");
    }

    void addPage() {
        Document& page = result_.page;
        page.title = spec_.spec.label;
        addSummary(page);
        addNodes(page);
        if (const auto formula = system_->isMovedOnlyBy<Mechanical>() ? formulaOf(scene_) : std::nullopt) {
            page.blocks.emplace_back(Document::Heading{"The Lagrangian of this scene"});
            page.blocks.emplace_back(Document::Formulas{equationsOf(*formula)});
        }
        // The passport's sections of formulas: those of the scheme, in this order.
        const Document passport = passportOf(scene_, place_, {.isMeasured = false});
        bool isFormula = false;
        for (const Document::Block& block : passport.blocks) {
            if (const auto* heading = std::get_if<Document::Heading>(&block))
                isFormula = heading->text != "Order conditions" &&
                            heading->text != "Symplecticity and symmetry of the coefficients";
            if (isFormula) page.blocks.push_back(block);
        }
    }

    void addSummary(Document& page) const {
        const StepReport& report = result_.report;
        Document::Table t{{"", ""}, {}};
        t.rows.push_back({"from " + system_->independent, formatNumber(result_.from.t, 8)});
        if (isDone()) {
            t.rows.push_back({"step", formatNumber(length(), 8)});
        } else {
            t.rows.push_back({"step", formatNumber(spec_.spec.step.value, 8)});
            t.rows.push_back({"outcome", std::string(name(report.outcome))});
        }
        t.rows.push_back({"iterations", std::to_string(report.cost.iterations)});
        t.rows.push_back({"evaluations", std::to_string(report.cost.evaluations)});
        t.rows.push_back({"linear solves", std::to_string(report.cost.linearSolves)});
        if (report.residual > 0) t.rows.push_back({"last correction", formatNumber(report.residual, 3)});
        page.blocks.emplace_back(Document::Heading{"This step"});
        page.blocks.emplace_back(std::move(t));
    }

    void addNodes(Document& page) {
        if (!isDone() || nodes_.place.empty() || nodes_.place.size() > 32 || !system_->hasCoordinates())
            return;
        Document::Table t{{"node", "c", "b", system_->independent}, {}};
        for (const Coordinate& q : system_->coordinates) t.columns.push_back(q.symbol);
        std::vector<double> x(after_.x.size());
        for (std::size_t i = 0; i < nodes_.place.size(); ++i) {
            const double c = nodes_.place[i];
            std::vector<std::string> row{std::to_string(i + 1), formatNumber(c, 8),
                                         formatNumber(nodes_.weight[i], 8),
                                         formatNumber(result_.from.t + c * length(), 8)};
            if (c >= 0 && c <= 1) {
                integrator_->denseOutput(c, x);
                for (std::size_t k = 0; k < system_->coordinates.size(); ++k)
                    row.push_back(formatNumber(x[k], 8));
            }
            row.resize(t.columns.size());
            t.rows.push_back(std::move(row));
        }
        page.blocks.emplace_back(Document::Heading{"Nodes, weights and the curve at the nodes"});
        page.blocks.emplace_back(std::move(t));
    }

    const ResolvedScene& scene_;
    const ResolvedScheme& spec_;
    std::size_t place_;
    std::shared_ptr<const System> system_;
    StepInspection result_;
    std::unique_ptr<Integrator> integrator_;
    State after_;
    Nodes nodes_;
    Comparison comparison_;
};

}  // namespace

StepInspection inspectStep(const ResolvedScene& scene, std::size_t scheme, const State& from,
                           const std::stop_token& stop) {
    return Inspection(scene, scheme, from).make(stop);
}

State stateBefore(const ResolvedScene& scene, const SchemeResult& result, double t) {
    State state = result.scheme ? initialOf(scene, *result.scheme) : scene.initial;
    const System& system = result.scheme ? *systemOf(scene, *result.scheme) : *scene.system;
    const auto times = result.trajectory["t"];
    std::size_t row = times.size();
    const double sign = scene.scene.end.value < scene.scene.start.value ? -1 : 1;
    for (std::size_t i = 0; i < times.size(); ++i)
        if (sign * times[i] <= sign * t) row = i;
    if (row == times.size()) return state;
    // The last row has no step behind it.
    if (row + 1 == times.size() && row > 0 && std::fabs(times[row] - scene.scene.end.value) < 1e-12) --row;
    const std::vector<Quantity> columns = stateColumns(system);
    if (columns.size() != state.x.size()) return state;  // rows do not hold all of it
    std::vector<double> x;
    for (const Quantity& column : columns) {
        const auto values = result.trajectory[column.name];
        if (row >= values.size() || !std::isfinite(values[row])) return state;
        x.push_back(values[row]);
    }
    state.t = times[row];
    state.node = 0;
    state.x = std::move(x);
    state.memory.clear();
    return state;
}

}  // namespace extremal
