// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/family/multiscale/product.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include "engine/action/chain_rule.hpp"
#include "engine/core/algebra/dense.hpp"
#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"
#include "engine/family/family.hpp"
#include "engine/family/multiscale/oscillatory.hpp"
#include "engine/family/multiscale/oscillatory_table.hpp"
#include "engine/family/multiscale/product_curve.hpp"
#include "engine/quadrature/rule.hpp"
#include "engine/solve/small_lu.hpp"

namespace extremal {
namespace {

class Product final : public Integrator {
public:
    Product(const System& system, std::vector<ProductCurve> curves, const Rule<double>& rule, double step,
            const SolverPolicy& policy, std::unique_ptr<Integrator> additive)
        : mechanics_(system.mechanics()),
          curves_(std::move(curves)),
          rule_(rule),
          h_(step),
          policy_(policy),
          additive_(std::move(additive)),
          at_(curves_.size()),
          start_(curves_.size()),
          end_(curves_.size()) {
        int size = 0;
        for (const ProductCurve& c : curves_) {
            offset_.push_back(size);
            size += c.size() + 1;
        }
        unknowns_.resize(static_cast<std::size_t>(size));
        residual_ = unknowns_;
        lu_ = SmallLu<double>(size);
        const std::size_t d = curves_.size();
        q_.resize(d);
        v_.resize(d);
        gradient_.resize(2 * d);
        hessian_.resize(4 * d * d);
        forces_.resize(rule_.c.size() * d);
        fitted_.x.resize(2 * d);
        for (const ProductCurve& c : curves_) fits_.push_back(fitOf(c));
    }
    Product(const Product& other)
        : Integrator(other),
          mechanics_(other.mechanics_),
          curves_(other.curves_),
          rule_(other.rule_),
          h_(other.h_),
          policy_(other.policy_),
          additive_(other.additive_->clone()),
          fits_(other.fits_),
          offset_(other.offset_),
          unknowns_(other.unknowns_),
          residual_(other.residual_),
          q_(other.q_),
          v_(other.v_),
          gradient_(other.gradient_),
          hessian_(other.hessian_),
          forces_(other.forces_),
          at_(other.at_),
          start_(other.start_),
          end_(other.end_),
          lu_(other.lu_),
          isFactorised_(other.isFactorised_),
          from_(other.from_),
          fitted_(other.fitted_) {}
    Product& operator=(const Product&) = delete;

    double stepSize() const override { return h_; }
    void setStep(double h) override {
        h_ = h;
        additive_->setStep(h);
        fits_.clear();
        for (const ProductCurve& c : curves_) fits_.push_back(fitOf(c));
    }
    void begin(State& state) override { additive_->begin(state); }
    std::unique_ptr<Integrator> clone() const override { return std::make_unique<Product>(*this); }
    bool checkpoint(Archive& archive) override { return additive_->checkpoint(archive); }

    StepReport advance(State& state, double until) override {
        StepReport report;
        report.step = h_;
        report.outcome = solve(state, report);
        if (report.outcome != Outcome::converged) return report;
        from_ = state;
        isFactorised_ = false;
        for (std::size_t k = 0; k < curves_.size(); ++k) {
            state.x[k] = end_[k].q.value;
            state.x[curves_.size() + k] = own(k)[curves_[k].size()];
        }
        state.t = until;
        ++state.node;
        return report;
    }

    std::size_t tangentSize() const override { return 2 * curves_.size(); }
    /// R(X; q_0, p_0) = 0 along a variation: the Jacobian at the solution is the one that convergence was
    /// seen with, and R depends on p_0 by p_0 dq(0)/dX, on q_0 by -q_0.
    bool applyTangent(std::span<double> W) override {
        if (!isFactorised_ && lu_.factorise() != Outcome::converged) return false;
        isFactorised_ = true;
        const std::size_t d = curves_.size();
        for (double* w = W.data(); w != W.data() + W.size(); w += 2 * d) {
            for (std::size_t k = 0; k < d; ++k) {
                const auto n = static_cast<std::size_t>(curves_[k].size());
                double* const right = residual_.data() + offset_[k];
                for (std::size_t j = 0; j < n; ++j) right[j] = -w[d + k] * start_[k].first[j].value;
                right[n] = w[k];
            }
            lu_.solve(residual_.data());
            for (std::size_t k = 0; k < d; ++k) {
                const auto n = static_cast<std::size_t>(curves_[k].size());
                const double* const change = residual_.data() + offset_[k];
                w[k] = 0;
                for (std::size_t j = 0; j < n; ++j) w[k] += end_[k].first[j].value * change[j];
                w[d + k] = change[n];
            }
        }
        return true;
    }

    /// p by its equation, and what that misses of the multiplier spread over the step.
    void denseOutput(double tau, std::span<double> x) const override {
        const std::size_t d = curves_.size();
        std::vector<double> share(rule_.c.size());
        partialWeights<double>(rule_, tau, share);
        ProductCurve::At at;
        for (std::size_t k = 0; k < d; ++k) {
            curves_[k].evaluate(tau * h_, h_, own(k), at);
            x[k] = at.q.value;
            double upTo = from_.x[d + k], whole = upTo;
            for (std::size_t i = 0; i < share.size(); ++i) {
                upTo += h_ * share[i] * forces_[i * d + k];
                whole += h_ * rule_.b[i] * forces_[i * d + k];
            }
            x[d + k] = upTo + tau * (own(k)[curves_[k].size()] - whole);
        }
    }

    double periodsPerStep() const override { return additive_->periodsPerStep(); }

    std::span<const double> unknowns() const { return unknowns_; }

private:
    static constexpr int fitSamples = 24;
    double* own(std::size_t k) { return unknowns_.data() + offset_[k]; }
    const double* own(std::size_t k) const { return unknowns_.data() + offset_[k]; }

    /// Coefficients of P_0..P_n, cos and sin in a curve from its samples.
    Eigen::MatrixXd fitOf(const ProductCurve& c) const {
        const OscillatoryBasis added(c.degree, {0});
        const double z = c.frequency * h_;
        const auto n = static_cast<std::size_t>(added.size());
        Eigen::MatrixXd functions(added.size(), fitSamples);
        std::vector<double> slopes(n);
        for (int i = 0; i < fitSamples; ++i) {
            const double tau = (i + 0.5) / fitSamples;
            added.evaluate<double>(tau, {z * tau, 0}, {z, 0}, {functions.col(i).data(), n}, slopes);
        }
        return dense::leastSquares<double>(functions.transpose(),
                                           Eigen::MatrixXd::Identity(fitSamples, fitSamples));
    }

    /// The additive curve with its amplitudes over the mean of P. Where even that has no solution, a
    /// constant.
    void guess(const State& state) {
        const std::size_t d = curves_.size();
        fitted_ = state;
        const bool isFound = extremal::advance(*additive_, fitted_).outcome == Outcome::converged;
        Eigen::MatrixXd samples(fitSamples, static_cast<Eigen::Index>(d));
        std::vector<double> x = state.x;
        for (int i = 0; i < fitSamples; ++i) {
            if (isFound) additive_->denseOutput((i + 0.5) / fitSamples, x);
            for (std::size_t k = 0; k < d; ++k) samples(i, static_cast<Eigen::Index>(k)) = x[k];
        }
        for (std::size_t k = 0; k < d; ++k) {
            const ProductCurve& c = curves_[k];
            const Eigen::VectorXd fit = fits_[k] * samples.col(static_cast<Eigen::Index>(k));
            double* X = own(k);
            for (int j = 0; j <= c.degree; ++j) X[j] = fit(j);
            const double mean = fit(0);
            X[c.degree + 1] = mean != 0 ? fit(c.degree + 2) / mean : 0;
            X[c.degree + 2] = mean != 0 ? fit(c.degree + 1) / mean : 0;
            if (c.isFree) X[c.degree + 3] = c.frequency;
            X[c.size()] = fitted_.x[d + k];
        }
    }

    Outcome solve(const State& state, StepReport& report) {
        guess(state);
        using Verdict = NewtonPolicy<double>::Verdict;
        NewtonPolicy<double> policy(NewtonLimits<double>::productStep());
        for (int iteration = 0; iteration < policy_.maxIterations; ++iteration) {
            if (stop().stop_requested()) return Outcome::stopped;
            if (!assemble(state, report)) return Outcome::notFinite;
            if (const Outcome factors = lu_.factorise(); factors != Outcome::converged) return factors;
            lu_.solve(residual_.data());
            ++report.cost.iterations;
            ++report.cost.linearSolves;
            const double size = correction(state);
            const Verdict verdict = policy.judge(size);
            if (verdict == Verdict::notFinite) return Outcome::notFinite;
            report.residual = size;
            if (verdict == Verdict::converged)
                return assemble(state, report) ? Outcome::converged : Outcome::notFinite;
        }
        return Outcome::diverged;
    }

    /// Takes the correction off X. Its size relative to the unknowns: slow part, amplitudes, frequency and
    /// momentum each to their own kind.
    double correction(const State& state) {
        double worst = 0;
        for (std::size_t k = 0; k < curves_.size(); ++k) {
            const ProductCurve& c = curves_[k];
            double* const X = own(k);
            const double* const delta = residual_.data() + offset_[k];
            const auto relative = [&](int first, int count, double least) {
                double change = 0, scale = least;
                for (int j = first; j < first + count; ++j) {
                    change = std::max(change, std::abs(delta[j]));
                    scale = std::max(scale, std::abs(X[j]));
                }
                worst = std::max(worst, change / (scale + std::numeric_limits<double>::min()));
            };
            relative(0, c.degree + 1, 0);
            relative(c.degree + 1, 2, 1);
            if (c.isFree) relative(c.degree + 3, 1, 0);
            relative(c.size(), 1, std::abs(state.x[curves_.size() + k]));
            for (int j = 0; j <= c.size(); ++j) X[j] -= delta[j];
        }
        return worst;
    }

    /// R and dR/dX at the present X; false where they are not finite.
    bool assemble(const State& state, StepReport& report) {
        const int d = static_cast<int>(curves_.size()), all = static_cast<int>(unknowns_.size());
        const double h = h_;
        std::fill(residual_.begin(), residual_.end(), 0.0);
        for (int j = 0; j < all; ++j) std::fill_n(lu_.column(j), all, 0.0);
        for (std::size_t i = 0; i < rule_.c.size(); ++i) {
            evaluate(rule_.c[i] * h, at_);
            for (std::size_t k = 0; k < at_.size(); ++k) {
                q_[k] = at_[k].q.value;
                v_[k] = at_[k].q.g[0];
            }
            double value = 0;
            mechanics_.jet(mechanics_.model.get(), state.t + rule_.c[i] * h, q_.data(), v_.data(), &value,
                           gradient_.data(), hessian_.data());
            ++report.cost.evaluations;
            if (!std::isfinite(value)) return false;
            std::copy_n(gradient_.begin(), d, forces_.begin() + static_cast<std::ptrdiff_t>(i) * d);
            for (int k = 0; k < d; ++k) addNode(k, rule_.b[i] * h);
        }
        evaluate(0, start_);
        evaluate(h, end_);
        for (int k = 0; k < d; ++k) addEnds(k, state);
        return std::all_of(residual_.begin(), residual_.end(), [](double r) { return std::isfinite(r); });
    }
    void evaluate(double t, std::vector<ProductCurve::At>& at) {
        for (std::size_t k = 0; k < curves_.size(); ++k) curves_[k].evaluate(t, h_, own(k), at[k]);
    }
    /// What the node in at_ adds to the equations of coordinate k: the chain rule, with w L' and w L'' in
    /// place of test functions with weights.
    void addNode(int k, double weight) {
        const int d = static_cast<int>(curves_.size()), n = curves_[static_cast<std::size_t>(k)].size();
        const ProductCurve::At& at = at_[static_cast<std::size_t>(k)];
        const double onQ = weight * gradient_[static_cast<std::size_t>(k)],
                     onV = weight * gradient_[static_cast<std::size_t>(d + k)];
        const int row = offset_[static_cast<std::size_t>(k)];
        const auto test = [&](int j) {
            const Moving& f = at.first[static_cast<std::size_t>(j)];
            return TestFunction<double>{f.value, f.g[0], f.value, f.g[0]};
        };
        addGradient(n, test, onQ, onV,
                    [&](int j) -> double& { return residual_[static_cast<std::size_t>(row + j)]; });
        addSecondDerivatives(
            n, [&](int j, int i) { return trial(at.second[static_cast<std::size_t>(i * n + j)]); }, onQ, onV,
            [&](int j, int i) -> double& { return lu_.column(row + i)[row + j]; });
        const auto H = [&](int i, int j) {
            return weight * hessian_[static_cast<std::size_t>(i * 2 * d + j)];
        };
        for (int l = 0; l < d; ++l) {
            const std::vector<Moving>& others = at_[static_cast<std::size_t>(l)].first;
            const int column = offset_[static_cast<std::size_t>(l)];
            addHessian(
                n, static_cast<int>(others.size()), test,
                [&](int i) { return trial(others[static_cast<std::size_t>(i)]); }, H(k, l), H(k, d + l),
                H(d + k, l), H(d + k, d + l),
                [&](int j, int i) -> double& { return lu_.column(column + i)[row + j]; });
        }
    }
    static TrialFunction<double> trial(const Moving& f) { return {f.value, f.g[0]}; }
    /// Continuity, its multipliers, and the momentum at the start.
    void addEnds(int k, const State& state) {
        const auto at = static_cast<std::size_t>(k);
        const int n = curves_[at].size(), row = offset_[at];
        const double p0 = state.x[curves_.size() + at], p1 = own(at)[n];
        double* const R = residual_.data() + row;
        for (int j = 0; j < n; ++j) {
            const auto a = static_cast<std::size_t>(j);
            R[j] += p0 * start_[at].first[a].value - p1 * end_[at].first[a].value;
            for (int i = 0; i < n; ++i) {
                const auto b = static_cast<std::size_t>(i * n + j);
                lu_.column(row + i)[row + j] +=
                    p0 * start_[at].second[b].value - p1 * end_[at].second[b].value;
            }
            lu_.column(row + n)[row + j] = -end_[at].first[a].value;
            lu_.column(row + j)[row + n] = start_[at].first[a].value;
        }
        R[n] = start_[at].q.value - state.x[at];
    }

    Mechanics<double> mechanics_;
    std::vector<ProductCurve> curves_;
    Rule<double> rule_;
    double h_;
    SolverPolicy policy_;
    std::unique_ptr<Integrator> additive_;
    std::vector<Eigen::MatrixXd> fits_;
    std::vector<int> offset_;
    std::vector<double> unknowns_, residual_, q_, v_, gradient_, hessian_;
    std::vector<double> forces_;  ///< L_q at node i at i * d + k
    std::vector<ProductCurve::At> at_, start_, end_;
    SmallLu<double> lu_;
    bool isFactorised_ = false;  ///< lu_, at the solution
    State from_, fitted_;
};

}  // namespace

std::span<const double> productUnknowns(const Integrator& product) {
    return dynamic_cast<const Product&>(product).unknowns();
}

bool isProduct(const Settings& space) { return space.type == "oscillatory-product"; }

Settings completeProductRule(const Settings&, const Settings& quadrature) {
    if (quadrature.type.empty() || quadrature.type == "auto") return {"auto", {}, {}};
    return completeOscillatoryRule({"oscillatory", {}, {}}, quadrature);
}

Properties describeProduct(const Settings&, const Settings& quadrature) {
    Properties p;
    p.claims.isSymmetric = false;
    p.claims.isSymplectic = true;
    p.stabilityLimit = std::numeric_limits<double>::infinity();
    p.space = "slow polynomials times one oscillation";
    p.knownAs = "product form";
    p.shortName = "MS*";
    p.caution =
        "is an experiment: its fast amplitudes are multiples of the slow parts, and steps have no solution "
        "where these pass "
        "through 0 or the amplitudes vanish. See the handbook, Multiscale";
    if (isFilon(quadrature)) {
        p.refusal = "the frequency may change from step to step, and a Filon rule needs it beforehand";
        p.hint = "auto, or a rule with 24 nodes a fast period";
    }
    return p;
}

std::unique_ptr<Integrator> makeProductIntegrator(const System& system, const Discretization& discretization,
                                                  const Clock& clock, const SolverPolicy& policy) {
    Discretization additive = discretization;
    additive.space.type = "oscillatory";
    std::erase_if(additive.space.keys, [](const auto& member) { return member.first == "frequency"; });
    additive.quadrature = {"auto", {}, {}};
    const Phases<double> z = oscillatoryPhases(system, additive.space, clock.step);
    if (z[1] != 0)
        throw InvalidScene("/space/omega", "must be one frequency in a product",
                           "the space oscillatory takes two");
    const double periods = std::abs(z[0]) / (2 * std::numbers::pi);
    if (!(periods < 1e4))
        throw InvalidScene(
            "/step", "has " + formatNumber(periods, 3) + " fast periods, and products resolve each of them",
            "a smaller step, or the space oscillatory");
    const bool isFree = discretization.space.text("frequency") == "free";
    std::vector<ProductCurve> curves;
    int degree = 0;
    for (const OscillatoryBasis& basis : oscillatoryBases(additive.space, system)) {
        curves.push_back({basis.degree, isFree, z[0] / clock.step});
        degree = std::max(degree, basis.degree);
    }
    const Rule<double> made = makeRule<double>(
        discretization.quadrature.type == "auto" ? resolvingRule(z[0], degree) : discretization.quadrature);
    checkResolution(z[0], made);
    return std::make_unique<Product>(system, std::move(curves), made, clock.step, policy,
                                     makeIntegrator(system, additive, clock));
}

}  // namespace extremal
