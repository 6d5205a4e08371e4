// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/family/modal_step.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>
#include <vector>

#include "engine/family/fourier_grid.hpp"
#include "engine/family/modal_march.hpp"
#include "engine/family/stage_tables.hpp"
#include "engine/model/field/element_grid.hpp"
#include "engine/model/plane_field/problem.hpp"

namespace extremal {
namespace {

struct StepInTime {
    int degree;
    Rule<double> rule;
    StageSolver solver;
};

template <class Grid>
class ModalField final : public ModalMarch<Grid> {
    using Base = ModalMarch<Grid>;
    using Base::components_, Base::grid_, Base::points_, Base::stride_, Base::values_;
    using Base::toModes, Base::toNodes, Base::squareOf, Base::h, Base::n;

public:
    ModalField(Grid grid, const SpectralDomain& domain, StepInTime time, double step)
        : Base(std::move(grid), domain, step),
          time_(std::move(time)),
          stages_(static_cast<std::size_t>(time_.rule.size())),
          width_(StageTables::widthOf(components_ * grid_.numbers())) {
        known_.resize(2 * n());
        for (auto* row : {&U_, &V_, &dU_, &dV_}) row->resize(width_);
        for (auto* rows : {&G_, &before_, &Y_}) rows->resize(width_ * stages_);
        for (auto* rows : {&u_, &varied_}) rows->resize(components_ * stride_ * stages_);
    }
    std::unique_ptr<Integrator> clone() const override { return std::make_unique<ModalField>(*this); }
    bool checkpoint(Archive& archive) override {
        const bool isWhole = FieldMarch::checkpoint(archive);  // it prepares, which forgets
        archive(isKnown_, known_, U_, V_, G_);
        return isWhole;
    }

private:
    void prepare() override {
        tables_ = StageTables(time_.degree, time_.rule, h(), this->linear_);
        isKnown_ = false;  // G of another step does not help
    }
    Outcome step(const double* x, double* next, StepReport& report) override {
        const std::size_t size = n();
        if (isKnown_ && std::memcmp(known_.data(), x, 2 * size * sizeof(double)) == 0) {
            before_.swap(G_);
            tables_.extrapolate(before_.data(), G_.data());
        } else {
            toModes(x, U_.data());
            toModes(x + size, V_.data());
            std::fill(G_.begin(), G_.end(), 0.0);
        }
        isKnown_ = false;  // until the step is done
        const Outcome solved =
            iterate(U_.data(), V_.data(), u_, report, [this](std::size_t) { this->evaluateSlope(); });
        if (solved != Outcome::converged) return solved;
        tables_.toEnd(G_.data(), U_.data(), V_.data());
        toNodes(U_.data(), next);
        toNodes(V_.data(), next + size);
        std::copy_n(next, 2 * size, known_.data());
        isKnown_ = true;
        return Outcome::converged;
    }

    /// Stages from U and V: G_ <- w u - R(u), until they change no more. `rest` makes slope_ = R of values_
    /// at stage i. `stages`: u at the points, of all stages.
    template <class Rest>
    Outcome iterate(const double* U, const double* V, std::vector<double>& stages, StepReport& report,
                    Rest&& rest) {
        constexpr double roundOff = 1e-14, stagnation = 1e-11;
        const double size = std::sqrt(squareOf(U)) + std::abs(h()) * std::sqrt(squareOf(V)),
                     tolerance = time_.solver.tolerance > 0 ? time_.solver.tolerance : roundOff;
        const int most = time_.solver.maxIterations > 0 ? time_.solver.maxIterations : 100;
        double last = 0;
        for (int k = 0; k < most; ++k) {
            if (this->stop().stop_requested()) return Outcome::stopped;
            ++report.cost.iterations;
            tables_.toStages(U, V, G_.data(), Y_.data());
            double squares = 0;
            for (std::size_t i = 0; i < stages_; ++i) {
                for (std::size_t c = 0; c < components_; ++c) {
                    double* const values = values_.data() + c * stride_;
                    grid_.toPoints(Y_.data() + i * width_ + c * grid_.numbers(), values);
                    squares += replace(values, stages.data() + (i * components_ + c) * stride_);
                }
                rest(i);
                this->forceToModes(G_.data() + i * width_);
            }
            report.cost.evaluations += static_cast<long long>(points_ * stages_);
            const double change = std::sqrt(squares / static_cast<double>(points_ * stages_));
            report.residual = size > 0 ? change / size : change;
            if (!std::isfinite(change)) return Outcome::notFinite;
            // In the first iteration the stages were those of the last step.
            if (k > 0 && change <= tolerance * size) return Outcome::converged;
            if (k > 1 && change >= last && change <= stagnation * size) return Outcome::converged;
            last = change;
        }
        return Outcome::diverged;
    }
    /// The sum of squares of the changes of a component; the stage is what its values are now.
    double replace(const double* values, double* stage) const {
        double sum[4] = {0, 0, 0, 0};  // which do not wait for each other
        std::size_t i = 0;
        for (; i + 4 <= points_; i += 4)
            for (std::size_t k = 0; k < 4; ++k) {
                const double d = values[i + k] - stage[i + k];
                sum[k] += d * d;
            }
        for (; i < points_; ++i) sum[0] += (values[i] - stage[i]) * (values[i] - stage[i]);
        std::copy_n(values, points_, stage);
        return (sum[0] + sum[1]) + (sum[2] + sum[3]);
    }
    /// W'' at the stages of the last step, which are still there.
    bool linearise() override {
        const std::size_t size = this->curvatureRows() * stride_;
        curvature_.resize(size * stages_);
        for (std::size_t i = 0; i < stages_; ++i)
            this->evaluateCurvature(u_.data() + i * components_ * stride_, curvature_.data() + i * size);
        return isKnown_;
    }
    /// The equations of the step are those of a variation with W'' u in place of W'(u).
    void vary(std::vector<double>& du, std::vector<double>& dp) override {
        toModes(du.data(), dU_.data());
        this->momentaToModes(dp, dV_.data());
        before_.swap(G_);  // G of the step stays for the next one
        std::fill(G_.begin(), G_.end(), 0.0);
        StepReport report;
        (void)iterate(dU_.data(), dV_.data(), varied_, report, [this](std::size_t i) {
            this->applyCurvature(curvature_.data() + i * this->curvatureRows() * stride_);
        });
        tables_.toEnd(G_.data(), dU_.data(), dV_.data());
        before_.swap(G_);
        toNodes(dU_.data(), du.data());
        this->modesToMomenta(dV_.data(), dp);
    }

    StepInTime time_;
    std::size_t stages_, width_;
    StageTables tables_;
    bool isKnown_ = false;
    std::vector<double> known_;       ///< the values that U_ and V_ belong to
    std::vector<double> U_, V_;       ///< modes of u and u_t
    std::vector<double> G_, before_;  ///< of the stages, and of those of the last step
    /// Stages: modes, component after component in a row, and values at the points.
    std::vector<double> Y_, u_;
    std::vector<double> dU_, dV_, varied_, curvature_;  ///< of variations
};

}  // namespace

SpectralDomain spectralDomainOf(const System& system) {
    if (const auto* const plane = system.parts.find<PlaneField>()) {
        const PlaneFieldProblem& p = *plane->problem;
        std::vector<double> stiffness;
        for (std::size_t c = 0; c < p.components(); ++c) stiffness.push_back(p.stiffness(c));
        return {p.grid().nx,       p.grid().ny,          p.grid().x.length,
                p.grid().y.length, std::move(stiffness), p.potential(), {}};
    }
    const FieldProblem& p = system.fieldProblem();
    return {p.size(), 1, p.mesh.length(), 1, {p.elastic.k}, p.potential, {}};
}

std::unique_ptr<Integrator> makeSpectralField(const SpectralDomain& domain, const SpectralScheme& scheme,
                                              double step) {
    return std::make_unique<ModalField<FourierGrid>>(
        FourierGrid(domain, scheme.nodes, scheme.nodesY), domain,
        StepInTime{scheme.degree, gauss<double>(scheme.degree), scheme.solver}, step);
}

std::unique_ptr<Integrator> makeElementField(const SpectralDomain& domain, const ElementScheme& scheme,
                                             double step) {
    return std::make_unique<ModalField<ElementGrid>>(
        ElementGrid({domain.nx, scheme.degree, domain.lengthX}, {domain.ny, scheme.degree, domain.lengthY},
                    scheme.alongX, scheme.alongY),
        domain, StepInTime{scheme.degreeInTime, scheme.inTime, scheme.solver}, step);
}

}  // namespace extremal
