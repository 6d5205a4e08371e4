// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/family/lie/quaternion_step.hpp"

#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "engine/action/table.hpp"
#include "engine/core/algebra/dense.hpp"
#include "engine/core/memo_cache.hpp"
#include "engine/family/lie/body_poses.hpp"
#include "engine/family/lie/lie.hpp"
#include "engine/family/lie/quaternion_kernel.hpp"
#include "engine/integrator/condensed.hpp"
#include "engine/model/group/lie_group.hpp"
#include "engine/solve/small_lu.hpp"

namespace extremal {
namespace {

using Vector = so3::Vector<double>;
using Quaternion = so3::Quaternion<double>;

Quaternion pure(const Vector& v) { return {0, v(0), v(1), v(2)}; }
Vector vectorOf(const Quaternion& q) { return q.tail<3>(); }

/// What follows from space and rule alone, which all steps share: short runs are set up in less time than a
/// step takes.
struct QuaternionTable {
    Table<double> table;
    Eigen::MatrixXd toCurve;  ///< Y = h toCurve F
    Eigen::MatrixXd a;

    explicit QuaternionTable(Table<double> of)
        : table(std::move(of)),
          toCurve(dense::inverse<double>(table.derivative)),
          a(dense::product<double>(table.value, toCurve)) {}
};

std::shared_ptr<const QuaternionTable> quaternionTable(const Discretization& d) {
    static MemoCache<std::pair<Settings, Settings>, std::shared_ptr<const QuaternionTable>> known(64);
    return known.get({d.space, d.quadrature}, [&] {
        return std::make_shared<const QuaternionTable>(lieTable(d.space, d.quadrature));
    });
}

class QuaternionStep final : public Integrator {
public:
    QuaternionStep(const BodyMechanics<double>& body, BodyPoses poses,
                   std::shared_ptr<const QuaternionTable> table, double step, const SolverPolicy& policy)
        : poses_(std::move(poses)),
          shared_(std::move(table)),
          table_(shared_->table),
          toCurve_(shared_->toCurve),
          a_(shared_->a),
          h_(step) {
        for (int i = 0; i < 3; ++i) {
            rate_(i) = 1 / body.inertia[static_cast<std::size_t>(i)];
            stages_.halfRate[i] = rate_(i) / 2;
        }
        stages_.stages = table_.nodes();
        stages_.maxSweeps = policy.maxIterations;
        stages_.tolerance = policy.tolerance;
        sweep_ = quaternionSweeps(table_.nodes());
        place();
    }

    double stepSize() const override { return h_; }
    void setStep(double h) override {
        h_ = h;
        place();
    }
    void begin(State&) override { poses_.forget(); }

    StepReport advance(State& state, double until) override {
        StepReport report;
        report.step = h_;
        start_ = poses_.read(state.x);
        if (stop().stop_requested()) {
            report.outcome = Outcome::stopped;
            return report;
        }
        guess();
        sweep_(stages_);
        report.residual = stages_.change;
        report.cost.iterations = stages_.sweeps;
        report.cost.evaluations = static_cast<long long>(stages_.sweeps) * stages_.stages;
        if (!stages_.isSolved) {
            report.outcome = std::isfinite(stages_.change) && stages_.sweeps == stages_.maxSweeps
                                 ? Outcome::diverged
                                 : Outcome::notFinite;
            return report;
        }
        Pose<double> end = start_;
        for (int c = 0; c < 4; ++c) {
            double sum = 0;
            for (int j = 0; j < stages_.stages; ++j) sum += table_.weight(j) * stages_.F[c][j];
            end.attitude(c) += h_ * sum;
        }
        end.attitude = so3::normalised(end.attitude);
        end_ = end.attitude;
        poses_.write(end, state.x);
        state.t = until;
        ++state.node;
        return report;
    }

    void denseOutput(double tau, std::span<double> x) const override {
        std::vector<double> value(static_cast<std::size_t>(table_.space.size)), slope(value.size());
        table_.space.evaluate(tau, value, slope);
        const Eigen::VectorXd phi = table_.change.transpose() *
                                    Eigen::Map<const Eigen::VectorXd>(value.data(), table_.space.size),
                              shares = toCurve_.transpose() * phi;
        Pose<double> at = start_;
        for (int c = 0; c < 4; ++c)
            for (int j = 0; j < stages_.stages; ++j) at.attitude(c) += h_ * shares(j) * stages_.F[c][j];
        at.attitude = so3::normalised(at.attitude);
        poses_.put(at, x.data());
    }

    std::size_t tangentSize() const override { return 6; }
    /// The stages vary by dQ_i - h sum_j a_ij dF_j = dq_0, with dF along Q and along pi.
    bool applyTangent(std::span<double> W) override {
        const int s = stages_.stages, columns = static_cast<int>(W.size() / 6);
        if (flat_.empty()) {  // the first variation
            lu_ = SmallLu<double>(4 * s);
            flat_.assign(static_cast<std::size_t>(4 * s), 0);
        }
        std::array<Quaternion, QuaternionStages::most> Q;
        std::array<Eigen::Matrix4d, QuaternionStages::most> slope;
        for (int i = 0; i < s; ++i) {
            Quaternion& at = Q[static_cast<std::size_t>(i)] = start_.attitude;
            for (int j = 0; j < s; ++j) at += h_ * a_(i, j) * rateAtStage(j);
            for (int c = 0; c < 4; ++c)
                slope[static_cast<std::size_t>(i)].col(c) = varied(at, Quaternion::Unit(c), Vector::Zero());
        }
        for (int j = 0; j < s; ++j)
            for (int c = 0; c < 4; ++c) {
                double* const column = lu_.column(4 * j + c);
                for (int i = 0; i < s; ++i)
                    for (int r = 0; r < 4; ++r)
                        column[4 * i + r] = (i == j && r == c ? 1 : 0) -
                                            h_ * a_(i, j) * slope[static_cast<std::size_t>(j)](r, c);
            }
        if (lu_.factorise() != Outcome::converged) return false;
        poses_.varyBody(W.data(), columns);
        for (int k = 0; k < columns; ++k) vary(W.data() + 6 * k, Q, slope);
        poses_.varyState(W.data(), columns);
        return true;
    }

    std::unique_ptr<Integrator> clone() const override { return std::make_unique<QuaternionStep>(*this); }
    bool checkpoint(Archive& archive) override {
        archive(poses_);
        return true;
    }

private:
    void place() {
        for (int j = 0; j < stages_.stages; ++j)
            for (int i = 0; i < QuaternionStages::most; ++i)
                stages_.a[j][i] = h_ * a_(std::min(i, stages_.stages - 1), j);
    }
    /// q' and its first two derivatives continue the motion from the start.
    void guess() {
        const Quaternion& q = start_.attitude;
        const Vector mu = so3::matrix(q).transpose() * start_.momentum, w = rate_.cwiseProduct(mu),
                     dMu = so3::cross(mu, w), dw = rate_.cwiseProduct(dMu),
                     ddw = rate_.cwiseProduct(so3::cross(dMu, w) + so3::cross(mu, dw));
        const Quaternion first = so3::product(q, pure(w)) / 2,
                         second = (so3::product(first, pure(w)) + so3::product(q, pure(dw))) / 2,
                         third = (so3::product(second, pure(w)) + 2 * so3::product(first, pure(dw)) +
                                  so3::product(q, pure(ddw))) /
                                 2;
        for (int c = 0; c < 4; ++c) {
            stages_.start[c] = q(c);
            for (int i = 0; i < QuaternionStages::most; ++i) {
                const double t = h_ * table_.node(std::min(i, stages_.stages - 1));
                stages_.F[c][i] = first(c) + t * (second(c) + t / 2 * third(c));
            }
        }
        for (int i = 0; i < 3; ++i) stages_.momentum[i] = start_.momentum(i);
    }
    Quaternion rateAtStage(int j) const {
        return {stages_.F[0][j], stages_.F[1][j], stages_.F[2][j], stages_.F[3][j]};
    }
    /// The change of q (0, I^-1 vec(q^* pi q)) / 2 with q and pi.
    Quaternion varied(const Quaternion& q, const Quaternion& dq, const Vector& dpi) const {
        const auto momentum = [](const Quaternion& a, const Vector& pi, const Quaternion& b) {
            return vectorOf(so3::product(so3::conjugate(a), so3::product(pure(pi), b)));
        };
        const Vector& pi = start_.momentum;
        const Vector mu = momentum(q, pi, q),
                     dMu = momentum(dq, pi, q) + momentum(q, pi, dq) + momentum(q, dpi, q);
        return (so3::product(dq, pure(rate_.cwiseProduct(mu))) +
                so3::product(q, pure(rate_.cwiseProduct(dMu)))) /
               2;
    }
    void vary(double* w, const std::array<Quaternion, QuaternionStages::most>& Q,
              const std::array<Eigen::Matrix4d, QuaternionStages::most>& slope) {
        const int s = stages_.stages;
        const Vector zeta(w[0], w[1], w[2]), dmu(w[3], w[4], w[5]);
        const so3::Matrix<double> R0 = so3::matrix(start_.attitude), R1 = so3::matrix(end_);
        const Vector mu = R0.transpose() * start_.momentum, dpi = R0 * (so3::cross(zeta, mu) + dmu);
        const Quaternion moved = so3::product(start_.attitude, pure(zeta)) / 2;
        std::array<Quaternion, QuaternionStages::most> dF;
        for (int i = 0; i < s; ++i)
            dF[static_cast<std::size_t>(i)] = varied(Q[static_cast<std::size_t>(i)], Quaternion::Zero(), dpi);
        for (int i = 0; i < s; ++i) {
            Quaternion right = moved;
            for (int j = 0; j < s; ++j) right += h_ * a_(i, j) * dF[static_cast<std::size_t>(j)];
            for (int c = 0; c < 4; ++c) flat_[static_cast<std::size_t>(4 * i + c)] = right(c);
        }
        lu_.solve(flat_.data());
        Quaternion dq = moved;
        for (int j = 0; j < s; ++j) {
            const Eigen::Map<const Quaternion> dQ(flat_.data() + 4 * j);
            const Quaternion rate = slope[static_cast<std::size_t>(j)] * dQ + dF[static_cast<std::size_t>(j)];
            dq += h_ * table_.weight(j) * rate;
        }
        const Vector turned = 2 * vectorOf(so3::product(so3::conjugate(end_), dq)),
                     change =
                         R1.transpose() * dpi - so3::cross(turned, Vector(R1.transpose() * start_.momentum));
        for (int i = 0; i < 3; ++i) {
            w[i] = turned(i);
            w[3 + i] = change(i);
        }
    }

    BodyPoses poses_;
    std::shared_ptr<const QuaternionTable> shared_;
    const Table<double>& table_;
    const Eigen::MatrixXd &toCurve_, &a_;
    double h_;
    Vector rate_;  ///< 1 / I
    QuaternionStages stages_;
    QuaternionSweeps sweep_ = nullptr;
    Pose<double> start_;
    Quaternion end_ = Quaternion::Unit(0);
    SmallLu<double> lu_;
    std::vector<double> flat_;
};

std::optional<BodyForm> formOf(const System& system) {
    const LieGroup* const group = system.parts.find<LieGroup>();
    return group ? BodyForm::of(*group->mechanics) : std::nullopt;
}

}  // namespace

std::string quaternionProblem(const System& system) {
    constexpr const char* own =
        "the momentum of a free body is constant, which polynomials in the quaternion need: ";
    if (const Body* const body = system.parts.find<Body>()) {
        if (body->dimension == 3 && body->isFree()) return {};
        return std::string(own) +
               (body->dimension == 3 ? "this one is in a potential" : "this one moves in space") +
               "; lie-polynomial steps it";
    }
    if (const auto form = formOf(system); form && form->body().isFree()) return {};
    return std::string(own) + "this is no Lagrangian of a free body; lie-polynomial steps it";
}

std::unique_ptr<Integrator> makeQuaternionIntegrator(const System& system, const Discretization& d,
                                                     double step) {
    const SolverPolicy policy = solverPolicy(d.solver, system);
    std::optional<BodyForm> form = formOf(system);
    const BodyMechanics<double> body = form ? form->body() : BodyMechanics<double>(system.body());
    return std::make_unique<QuaternionStep>(body, BodyPoses(std::move(form)), quaternionTable(d), step,
                                            policy);
}

}  // namespace extremal
