// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/family/modal_step.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <utility>
#include <vector>

#include "engine/core/algebra/lanes.hpp"
#include "engine/family/stage_tables.hpp"
#include "engine/model/field/element_grid.hpp"
#include "engine/model/field/spectral_grid.hpp"
#include "engine/model/plane_field/problem.hpp"
#include "engine/step/field_march.hpp"

namespace extremal {
namespace {

/// The ways of Fourier modes; a row has the real and the imaginary part of each.
class FourierGrid {
public:
    FourierGrid(const SpectralDomain& domain, const SpectralScheme& scheme)
        : grid_(domain.nx, domain.ny, scheme.nodes, domain.ny > 1 ? scheme.nodesY : 1),
          mass_(domain.lengthX * domain.lengthY / static_cast<double>(grid_.nodes())) {
        const double turn = 2 * std::numbers::pi, baseX = turn / domain.lengthX,
                     baseY = turn / domain.lengthY;
        for (int l = 0; l < domain.ny; ++l)
            for (int k = 0; k <= domain.nx / 2; ++k) {
                const double K = baseX * k, L = baseY * (2 * l > domain.ny ? l - domain.ny : l);
                gradients_.insert(gradients_.end(), 2, K * K + L * L);
            }
    }
    const std::vector<double>& gradients() const { return gradients_; }
    std::size_t nodes() const { return grid_.nodes(); }
    std::size_t points() const { return grid_.points(); }
    std::size_t numbers() const { return 2 * grid_.modes(); }
    void toModes(const double* nodes, double* row) { grid_.toModes(nodes, row); }
    void toNodes(const double* row, double* nodes) { grid_.toNodes(row, nodes); }
    void toPoints(const double* row, double* values) { grid_.toPoints(row, values); }
    double pointShare() const { return 1 / static_cast<double>(points()); }
    void fromPoints(const double* values, double* row) { grid_.fromPoints(values, row); }
    void fromMomenta(const double* momenta, double* row) {
        grid_.toModes(momenta, row);
        for (std::size_t i = 0; i < numbers(); ++i) row[i] /= mass_;
    }
    void toMomenta(const double* row, double* momenta) {
        grid_.toNodes(row, momenta);
        for (std::size_t i = 0; i < nodes(); ++i) momenta[i] *= mass_;
    }
    double squareOf(const double* row) const { return grid_.squareOf(row); }

private:
    SpectralGrid grid_;
    double mass_;  ///< of a node
    std::vector<double> gradients_;
};

struct StepInTime {
    int degree;
    Rule<double> rule;
    StageSolver solver;
};

template <class Grid>
class ModalField final : public FieldMarch {
public:
    ModalField(Grid grid, const SpectralDomain& domain, StepInTime time, double step)
        : FieldMarch(domain.potential.components() * grid.nodes(), step),
          potential_(domain.potential),
          time_(std::move(time)),
          components_(domain.potential.components()),
          shifts_(domain.potential.meanCurvatures()),
          stages_(static_cast<std::size_t>(time_.rule.size())),
          grid_(std::move(grid)),
          points_(grid_.points()),
          stride_((points_ + Lanes::size - 1) / Lanes::size * Lanes::size),
          width_(StageTables::widthOf(components_ * grid_.numbers())) {
        for (std::size_t c = 0; c < components_; ++c)
            for (const double each : grid_.gradients())
                linear_.push_back(domain.stiffness[c] * each + shifts_[c]);
        known_.resize(2 * n());
        for (auto* row : {&U_, &V_, &dU_, &dV_}) row->resize(width_);
        for (auto* rows : {&G_, &before_, &Y_}) rows->resize(width_ * stages_);
        for (auto* rows : {&u_, &varied_}) rows->resize(components_ * stride_ * stages_);
        values_.resize(components_ * stride_);
        slope_.resize(components_ * stride_);
    }
    std::unique_ptr<Integrator> clone() const override { return std::make_unique<ModalField>(*this); }
    bool checkpoint(Archive& archive) override {
        const bool isWhole = FieldMarch::checkpoint(archive);  // it prepares, which forgets
        archive(isKnown_, known_, U_, V_, G_);
        return isWhole;
    }

private:
    void prepare() override {
        tables_ = StageTables(time_.degree, time_.rule, h(), linear_);
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
        const Outcome solved = iterate(U_.data(), V_.data(), u_, report, [this](std::size_t) {
            potential_.evaluate(values_.data(), points_, stride_, nullptr, slope_.data(), nullptr);
        });
        if (solved != Outcome::converged) return solved;
        tables_.toEnd(G_.data(), U_.data(), V_.data());
        toNodes(U_.data(), next);
        toNodes(V_.data(), next + size);
        std::copy_n(next, 2 * size, known_.data());
        isKnown_ = true;
        return Outcome::converged;
    }

    void toModes(const double* nodes, double* row) {
        for (std::size_t c = 0; c < components_; ++c)
            grid_.toModes(nodes + c * grid_.nodes(), row + c * grid_.numbers());
    }
    void toNodes(const double* row, double* nodes) {
        for (std::size_t c = 0; c < components_; ++c)
            grid_.toNodes(row + c * grid_.numbers(), nodes + c * grid_.nodes());
    }
    double squareOf(const double* row) const {
        double sum = 0;
        for (std::size_t c = 0; c < components_; ++c) sum += grid_.squareOf(row + c * grid_.numbers());
        return sum;
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
            if (stop().stop_requested()) return Outcome::stopped;
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
                forceToModes(G_.data() + i * width_);
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
    void forceToModes(double* row) {
        const double share = grid_.pointShare();
        for (std::size_t c = 0; c < components_; ++c) {
            double* const values = values_.data() + c * stride_;
            const double* const slope = slope_.data() + c * stride_;
            for (std::size_t i = 0; i < points_; ++i) values[i] = share * (shifts_[c] * values[i] - slope[i]);
            grid_.fromPoints(values, row + c * grid_.numbers());
        }
    }

    bool hasVariations() const override { return true; }
    /// W'' at the stages of the last step, which are still there.
    bool linearise() override {
        const std::size_t rows = components_ * (components_ + 1) / 2;
        curvature_.resize(rows * stride_ * stages_);
        for (std::size_t i = 0; i < stages_; ++i)
            potential_.evaluate(u_.data() + i * components_ * stride_, points_, stride_, nullptr, nullptr,
                                curvature_.data() + i * rows * stride_);
        return isKnown_;
    }
    /// slope_ <- W'' values_ at stage i.
    void applyCurvature(std::size_t i) {
        const double* curvature = curvature_.data() + i * components_ * (components_ + 1) / 2 * stride_;
        std::fill(slope_.begin(), slope_.end(), 0.0);
        for (std::size_t c = 0; c < components_; ++c)
            for (std::size_t d = 0; d <= c; ++d, curvature += stride_)
                for (std::size_t j = 0; j < points_; ++j) {
                    slope_[c * stride_ + j] += curvature[j] * values_[d * stride_ + j];
                    if (d < c) slope_[d * stride_ + j] += curvature[j] * values_[c * stride_ + j];
                }
    }
    /// The equations of the step are those of a variation with W'' u in place of W'(u).
    void vary(std::vector<double>& du, std::vector<double>& dp) override {
        toModes(du.data(), dU_.data());
        for (std::size_t c = 0; c < components_; ++c)
            grid_.fromMomenta(dp.data() + c * grid_.nodes(), dV_.data() + c * grid_.numbers());
        before_.swap(G_);  // G of the step stays for the next one
        std::fill(G_.begin(), G_.end(), 0.0);
        StepReport report;
        (void)iterate(dU_.data(), dV_.data(), varied_, report, [this](std::size_t i) { applyCurvature(i); });
        tables_.toEnd(G_.data(), dU_.data(), dV_.data());
        before_.swap(G_);
        toNodes(dU_.data(), du.data());
        for (std::size_t c = 0; c < components_; ++c)
            grid_.toMomenta(dV_.data() + c * grid_.numbers(), dp.data() + c * grid_.nodes());
    }

    JointPotential potential_;
    StepInTime time_;
    std::size_t components_;
    std::vector<double> shifts_;  ///< w of each component
    std::size_t stages_;
    Grid grid_;
    std::size_t points_, stride_;  ///< from one component to the next: each begins where arrays are aligned
    std::size_t width_;
    std::vector<double> linear_;  ///< c^2 k^2 + w of each number in a row
    StageTables tables_;
    bool isKnown_ = false;
    std::vector<double> known_;       ///< the values that U_ and V_ belong to
    std::vector<double> U_, V_;       ///< modes of u and u_t
    std::vector<double> G_, before_;  ///< of the stages, and of those of the last step
    /// Stages: modes, component after component in a row, and values at the points.
    std::vector<double> Y_, u_;
    std::vector<double> values_, slope_;
    std::vector<double> dU_, dV_, varied_, curvature_;  ///< of variations
};

}  // namespace

SpectralDomain spectralDomainOf(const System& system) {
    if (const auto* const plane = system.parts.find<PlaneField>()) {
        const PlaneFieldProblem& p = *plane->problem;
        std::vector<double> stiffness;
        for (std::size_t c = 0; c < p.components(); ++c) stiffness.push_back(p.stiffness(c));
        return {p.grid().nx,       p.grid().ny,          p.grid().x.length,
                p.grid().y.length, std::move(stiffness), p.potential()};
    }
    const FieldProblem& p = system.fieldProblem();
    return {p.size(), 1, p.mesh.length(), 1, {p.elastic.k}, p.potential};
}

std::unique_ptr<Integrator> makeSpectralField(const SpectralDomain& domain, const SpectralScheme& scheme,
                                              double step) {
    return std::make_unique<ModalField<FourierGrid>>(
        FourierGrid(domain, scheme), domain,
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
