// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/family/free_knot/knots.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "engine/mesh/equidistribution.hpp"
#include "engine/model/typed/typed_function.hpp"
#include "engine/solve/band_lu.hpp"

namespace extremal {
namespace {

/// Elements of the solution from which densities are known, at least four times as many as any other has.
constexpr int fineElements = 4000;
/// Free knots start from those of the density, moved by these parts of their distance: the energy has many
/// minima, some of them, which are symmetric, only saddle points of the others. The least one counts.
constexpr double shifts[] = {0, 0.02, 0.05, 0.1, 0.15, 0.2, 0.3, 0.5, 0.7, 0.85};

/// What one search may evaluate, in instructions of the energy density: about three seconds. 512 free knots
/// on a steep profile need 1.5e8; what needs more has no minimum, for the most part.
constexpr double mostWork = 2e8;

/// Values and knots, (u_i, x_i) one after the other, with the energy and its derivatives.
class Profile {
public:
    /// `left`: what the search may still evaluate.
    Profile(const StaticProblem& problem, const std::vector<double>& x, const std::vector<double>& u,
            double& left)
        : problem_(problem),
          n_(x.size()),
          elements_(n_ - 1),
          lu_(static_cast<int>(2 * n_), 3),
          left_(left),
          work_(workOf(problem, elements_.size())) {
        z_.resize(2 * n_);
        for (std::size_t i = 0; i < n_; ++i) {
            z_[2 * i] = u[i];
            z_[2 * i + 1] = x[i];
        }
        gradient_.resize(2 * n_);
        evaluate();
    }

    /// Stationary in the values, and in the knots where they are free; `enough`: the residual, relative.
    Outcome solve(bool areFree, Cost& cost, double enough = 1e-13) {
        constexpr int mostSteps = 2000;
        constexpr double lost = 1e14, known = 1e-14;
        areFree_ = areFree;
        double damping = 1e-3;
        evaluate();
        for (int i = 0; i < mostSteps; ++i) {
            if (residual() <= enough * scale()) return Outcome::converged;
            if (damping > lost || left_ < 0) break;
            ++cost.iterations;
            const std::vector<double> before = z_;
            const double energy = energy_, residualBefore = residual();
            if (!step(damping, cost)) {
                damping = harder(damping);
                continue;
            }
            evaluate();
            const bool isBetter =
                energy_ < energy - known * std::abs(energy) ||
                (energy_ <= energy + known * std::abs(energy) && residual() < residualBefore);
            if (isBetter) {
                damping = damping > 1e-12 ? damping / 5 : 0;
                continue;
            }
            z_ = before;
            evaluate();
            damping = harder(damping);
        }
        // What is left is round-off; knots that have met cannot go on to where the derivatives vanish.
        constexpr double roundOff = 1e-8;
        bool haveMet = false;
        for (std::size_t e = 0; e + 1 < n_; ++e) haveMet = haveMet || isLeast(e);
        return haveMet || residual() <= roundOff * scale() ? Outcome::converged : Outcome::diverged;
    }

    KnotProfile result() const {
        KnotProfile p;
        for (std::size_t i = 0; i < n_; ++i) {
            p.u.push_back(z_[2 * i]);
            p.x.push_back(z_[2 * i + 1]);
        }
        for (std::size_t e = 0; e + 1 < n_; ++e) {
            p.energy.push_back(elements_[e].energy);
            p.atLeft.push_back(-elements_[e].gradient[1]);
            p.atRight.push_back(elements_[e].gradient[3]);
            p.hasMet.push_back(isLeast(e));
        }
        return p;
    }

private:
    static double harder(double damping) { return std::max(4 * damping, 1e-12); }
    double least() const { return leastKnotDistance * problem_.length(); }
    double size(std::size_t e) const { return z_[2 * e + 3] - z_[2 * e + 1]; }
    bool isLeast(std::size_t e) const { return size(e) < 1.001 * least(); }
    /// Unknowns that stay as they are: the ends of the domain, values that are held there, knots that are
    /// given or have met.
    bool isHeld(std::size_t k) const {
        const std::size_t i = k / 2;
        const bool isEnd = i == 0 || i + 1 == n_;
        if (k % 2 == 0) return isEnd && problem_.isHeld;
        return isEnd || !areFree_ || isLeast(i - 1) || isLeast(i);
    }

    /// Of one evaluation: panels, and the two ends of elements.
    static double workOf(const StaticProblem& problem, std::size_t elements) {
        const double panels = problem.length() / problem.resolution + static_cast<double>(elements);
        return panels * static_cast<double>(20 + problem.W->length());
    }

    void evaluate() {
        left_ -= work_;
        energy_ = 0;
        std::fill(gradient_.begin(), gradient_.end(), 0.0);
        for (std::size_t e = 0; e + 1 < n_; ++e) {
            elements_[e] = staticElement(problem_, z_.data() + 2 * e);
            energy_ += elements_[e].energy;
            for (std::size_t a = 0; a < 4; ++a) gradient_[2 * e + a] += elements_[e].gradient[a];
        }
    }
    double residual() const {
        double most = 0;
        for (std::size_t k = 0; k < gradient_.size(); ++k)
            if (!isHeld(k) && !(std::abs(gradient_[k]) <= most)) most = std::abs(gradient_[k]);
        return most;
    }
    double scale() const {
        double most = std::numeric_limits<double>::min();
        for (const StaticElement& e : elements_)
            for (const double each : e.gradient) most = std::max(most, std::abs(each));
        return most;
    }

    /// Of Newton's method, damped. False: the matrix has no inverse.
    bool step(double damping, Cost& cost) {
        lu_.clear();
        std::vector<double> delta(2 * n_, 0), diagonal(2 * n_, 0);
        for (std::size_t e = 0; e + 1 < n_; ++e)
            for (std::size_t a = 0; a < 4; ++a) {
                const std::size_t i = 2 * e + a;
                diagonal[i] += std::abs(elements_[e].hessian[a][a]);
                for (std::size_t b = 0; b < 4; ++b)
                    if (!isHeld(i) && !isHeld(2 * e + b))
                        lu_.add(static_cast<int>(i), static_cast<int>(2 * e + b), elements_[e].hessian[a][b]);
            }
        for (std::size_t k = 0; k < 2 * n_; ++k) {
            if (isHeld(k)) {
                lu_.fix(static_cast<int>(k));
            } else {
                lu_.add(static_cast<int>(k), static_cast<int>(k), damping * diagonal[k]);
                delta[k] = -gradient_[k];
            }
        }
        cost.linearSolves += 2;
        if (!lu_.factorise()) return false;
        lu_.solve(delta.data());
        // No element shrinks to less than a third of itself, or below the least length.
        double part = 1;
        for (std::size_t e = 0; e + 1 < n_; ++e) {
            const double change = delta[2 * e + 3] - delta[2 * e + 1],
                         allowed = size(e) - std::max(size(e) / 3, least());
            if (-change * part > allowed) part = std::max(0.0, allowed) / -change;
        }
        for (std::size_t k = 0; k < 2 * n_; ++k) {
            if (!std::isfinite(delta[k])) return false;
            z_[k] += part * delta[k];
        }
        return true;
    }

    const StaticProblem& problem_;
    std::size_t n_;
    bool areFree_ = false;
    std::vector<double> z_, gradient_;
    std::vector<StaticElement> elements_;
    double energy_ = 0;
    BandLu lu_;
    double& left_;
    double work_;
};

std::vector<double> equalKnots(const StaticProblem& problem, int elements) {
    std::vector<double> x;
    for (int i = 0; i <= elements; ++i) x.push_back(problem.left + problem.length() * i / elements);
    x.back() = problem.right;
    return x;
}

/// A fine solution at other places.
std::vector<double> valuesOf(const KnotProfile& fine, const std::vector<double>& x) {
    std::vector<double> u;
    std::size_t e = 0;
    for (const double at : x) {
        while (e + 2 < fine.x.size() && fine.x[e + 1] < at) ++e;
        const double xi = (at - fine.x[e]) / (fine.x[e + 1] - fine.x[e]);
        u.push_back((1 - xi) * fine.u[e] + xi * fine.u[e + 1]);
    }
    return u;
}

/// A straight line between the values at the ends, for the iteration to start from.
std::vector<double> straight(const StaticProblem& problem, const std::vector<double>& x) {
    std::vector<double> u;
    for (const double at : x)
        u.push_back(problem.uLeft +
                    (problem.uRight - problem.uLeft) * (at - problem.left) / problem.length());
    return u;
}

std::vector<double> densityOf(const KnotProfile& fine, Knots knots, bool hasSlopes) {
    const std::size_t n = fine.x.size();
    std::vector<double> M, u_xx;
    curvatures(fine.x.data(), fine.u.data(), n, u_xx);
    const double power = hasSlopes ? 2.0 / 3 : 2.0 / 5;
    for (std::size_t e = 0; e + 1 < n; ++e) {
        const double slope = (fine.u[e + 1] - fine.u[e]) / (fine.x[e + 1] - fine.x[e]);
        M.push_back(knots == Knots::arclength ? std::hypot(1, slope)
                                              : std::pow(std::abs(u_xx[e] + u_xx[e + 1]) / 2, power));
    }
    if (knots == Knots::arclength) return M;
    constexpr double part = 0.02;
    const double mean = std::accumulate(M.begin(), M.end(), 0.0) / static_cast<double>(M.size());
    for (double& each : M) each += mean > 0 ? part * mean : 1;
    return M;
}

}  // namespace

double KnotProfile::total() const { return std::accumulate(energy.begin(), energy.end(), 0.0); }

KnotProfile fineProfile(const StaticProblem& problem) {
    Cost cost;
    double left = mostWork;
    KnotProfile found;
    // For densities only. From few elements to many: most iterations are spent where they cost least.
    constexpr double enough = 1e-9;
    for (const int elements : {fineElements / 16, fineElements / 4, fineElements}) {
        const std::vector<double> x = equalKnots(problem, elements);
        Profile profile(problem, x, found.x.empty() ? straight(problem, x) : valuesOf(found, x), left);
        const Outcome outcome = profile.solve(false, cost, enough);
        found = profile.result();
        found.outcome = outcome;
    }
    found.cost = cost;
    return found;
}

KnotProfile findProfile(const StaticProblem& problem, int elements, Knots knots, const KnotProfile& fine) {
    Cost cost;
    double left = mostWork;
    std::vector<double> x = equalKnots(problem, elements), u = straight(problem, x);
    Outcome outcome = Outcome::converged;
    if (knots != Knots::equal) {
        cost = fine.cost;
        outcome = fine.outcome;
        equidistribute(fine.x, densityOf(fine, knots, problem.stiffness > 0), x);
        // Values that are too large for their densities have no knots.
        const bool isOrdered =
            x.front() >= problem.left && x.back() <= problem.right && std::is_sorted(x.begin(), x.end()) &&
            std::all_of(x.begin(), x.end(), [](double each) { return std::isfinite(each); });
        if (!isOrdered) {
            outcome = Outcome::diverged;
            x = equalKnots(problem, elements);
        }
        u = valuesOf(fine, x);
    }
    KnotProfile best;
    int failures = 0;
    const auto seek = [&](const std::vector<double>& start, bool areFree) {
        Profile profile(problem, start, u, left);
        Outcome own = outcome;
        if (own == Outcome::converged) own = profile.solve(false, cost);
        if (own == Outcome::converged && areFree) own = profile.solve(true, cost);
        KnotProfile found = profile.result();
        found.outcome = own;
        const bool isDone = own == Outcome::converged, wasDone = best.outcome == Outcome::converged;
        if (!isDone) ++failures;
        if (best.x.empty() || (isDone && !wasDone) || (isDone == wasDone && found.total() < best.total()))
            best = std::move(found);
    };
    if (knots != Knots::free) {
        seek(x, false);
    } else {
        constexpr int mostFailures = 3;
        for (const double shift : shifts) {
            if (left < 0 || failures >= mostFailures) break;
            std::vector<double> start = x;
            for (std::size_t i = 1; i + 1 < x.size(); ++i) start[i] += shift * (x[i + 1] - x[i]);
            seek(start, true);
        }
    }
    best.cost = cost;
    return best;
}

KnotProfile findProfile(const StaticProblem& problem, int elements, Knots knots) {
    return findProfile(problem, elements, knots,
                       knots == Knots::equal ? KnotProfile{} : fineProfile(problem));
}

}  // namespace extremal
