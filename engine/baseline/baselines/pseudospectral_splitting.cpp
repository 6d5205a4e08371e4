// SPDX-License-Identifier: GPL-3.0-or-later
/// Pseudospectral splitting for periodic fields: half a kick by W', the free wave exactly in Fourier space,
/// half a kick. Spectral in space, order 2 in time, without a stability limit of the wave.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

#include "engine/baseline/catalog.hpp"
#include "engine/baseline/field_method.hpp"
#include "engine/baseline/parts.hpp"
#include "engine/core/problem.hpp"
#include "engine/model/wave/basis/fourier.hpp"
#include "engine/step/field_march.hpp"

namespace extremal::baselines {
namespace {

/// One complex transform serves u and v, which are real: psi = u + i v.
class FieldSplitting final : public FieldMarch {
public:
    FieldSplitting(std::shared_ptr<const SpatialForm> shape, double step)
        : FieldMarch(std::move(shape), step),
          fourier_(wave::Grid{{form().problem().mesh.left(), form().problem().mesh.length()}, form().size()}),
          psi_(n()),
          c_(n()),
          slope_(n()),
          of_(n()) {}
    std::unique_ptr<Integrator> clone() const override { return std::make_unique<FieldSplitting>(*this); }
    bool checkpoint(Archive& archive) override {
        archive(isKnown_, of_, slope_);
        return FieldMarch::checkpoint(archive);
    }

private:
    void prepare() override {
        flow_.clear();
        const double speed = form().problem().speed();
        for (int i = 0; i < form().size(); ++i) {
            const double w = speed * std::abs(fourier_.waveNumber(i)), angle = w * h();
            flow_.push_back({std::cos(angle), w > 0 ? std::sin(angle) / w : h(), -w * std::sin(angle)});
        }
    }
    Outcome step(const double* x, double* next, StepReport& report) override {
        const std::size_t size = n();
        report.cost.evaluations = 2;
        kick(x, x + size, next + size, report.cost);
        std::copy_n(x, size, next);
        fly(next, next + size);
        kick(next, next + size, next + size, report.cost);
        return Outcome::converged;
    }
    /// The free wave over h.
    void fly(double* u, double* v) {
        const std::size_t size = n();
        for (std::size_t i = 0; i < size; ++i) psi_[i] = {u[i], v[i]};
        fourier_.rawToCoefficients(psi_.data(), c_.data());
        // Coefficients of u and v from those of u + i v, at k and -k together.
        const double scale = 1 / static_cast<double>(size);
        for (int i = 0; i < form().size(); ++i) {
            const int j = fourier_.placeOf(-fourier_.number(i));
            if (j < i) continue;
            Complex& a = c_[static_cast<std::size_t>(i)];
            Complex& b = c_[static_cast<std::size_t>(j)];
            const Complex U = (a + std::conj(b)) / 2.0, V = (a - std::conj(b)) / Complex(0, 2);
            const Flow& f = flow_[static_cast<std::size_t>(i)];
            const Complex newU = scale * (f.keep * U + f.fromV * V),
                          newV = scale * (f.fromU * U + f.keep * V);
            a = newU + Complex(0, 1) * newV;
            b = std::conj(newU) + Complex(0, 1) * std::conj(newV);
        }
        fourier_.rawToNodes(c_.data(), psi_.data());
        for (std::size_t i = 0; i < size; ++i) {
            u[i] = psi_[i].real();
            v[i] = psi_[i].imag();
        }
    }
    /// The slopes at the end of a step are those at the start of the next.
    void kick(const double* u, const double* v, double* kicked, Cost& cost) {
        if (!isKnown_ || std::memcmp(of_.data(), u, n() * sizeof(double)) != 0) {
            form().problem().potential.evaluate(u, n(), nullptr, slope_.data(), nullptr);
            std::copy_n(u, n(), of_.begin());
            isKnown_ = true;
            cost.evaluations += static_cast<long long>(n());
        }
        for (std::size_t i = 0; i < n(); ++i) kicked[i] = v[i] - h() / 2 * slope_[i];
    }

    bool hasVariations() const override { return true; }
    bool linearise() override {
        std::vector<double> after(2 * n());
        StepReport ignored;
        if (step(before().data(), after.data(), ignored) != Outcome::converged) return false;
        atStart_ = curvature(before().data());
        atEnd_ = curvature(after.data());
        return true;
    }
    std::vector<double> curvature(const double* u) const {
        std::vector<double> all(n());
        form().problem().potential.evaluate(u, n(), nullptr, nullptr, all.data());
        return all;
    }
    /// The kicks and the free wave are linear in a variation; its momenta are dx dv.
    void vary(std::vector<double>& du, std::vector<double>& dp) override {
        const double mass = form().problem().mesh.length() / static_cast<double>(n());
        for (std::size_t i = 0; i < n(); ++i) dp[i] = dp[i] / mass - h() / 2 * atStart_[i] * du[i];
        fly(du.data(), dp.data());
        for (std::size_t i = 0; i < n(); ++i) dp[i] = (dp[i] - h() / 2 * atEnd_[i] * du[i]) * mass;
    }

    struct Flow {
        double keep, fromV, fromU;
    };
    Fourier fourier_;
    std::vector<Flow> flow_;
    std::vector<Complex> psi_, c_;
    bool isKnown_ = false;
    std::vector<double> slope_, of_;       ///< W', and the values it belongs to
    std::vector<double> atStart_, atEnd_;  ///< W'' at the ends of the last step
};

}  // namespace

BaselineEntry pseudospectral_splitting() {
    BaselineEntry e;
    e.item = {
        "pseudospectral-splitting",
        "pseudospectral splitting",
        "Periodic fields: the free wave exactly in Fourier space, the potential in half kicks; spectral in "
        "space.",
        {},
        Claims{2, true, true, {"momentum"}},
        "a periodic field"};
    e.takes = Takes::only<ScalarField>();
    e.parts.set(OscillatorLimit(std::numeric_limits<double>::infinity()));
    e.make = [](const System& system, const BaselineOptions& options) -> std::unique_ptr<Integrator> {
        const FieldProblem& problem = system.fieldProblem();
        if (!problem.mesh.isPeriodic() || !problem.mesh.isUniform() || problem.nodes.degree != 1 ||
            problem.coefficient || !problem.elastic.isLinear())
            throw InvalidScene(
                "/baseline",
                "pseudospectral-splitting needs a periodic field with one wave speed on a uniform "
                "mesh",
                "leapfrog, or the boundary periodic");
        return std::make_unique<FieldSplitting>(lumpedForm(system), options.step);
    };
    return e;
}

}  // namespace extremal::baselines
