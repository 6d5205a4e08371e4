// SPDX-License-Identifier: GPL-3.0-or-later
/// The solution of a step followed from a short step to the whole one: what is tried where Newton's method
/// fails from every starting value.
///
/// The unknowns Y(h) of a step, differences from its start, are a smooth curve with Y(0) = 0. A short step is
/// solved from what is known at its start; the solutions so far, continued to a somewhat longer step by the
/// polynomial through the last of them, are the starting value there. The length between two solutions grows
/// while Newton's method succeeds, and is halved where it fails. The root found is the one that belongs to
/// the motion, as it is that of short steps.
///
/// It is for steps whose domain is thin, such as velocities just below that of light: every straight line
/// from a starting value to the solution leaves the shell in which velocities lie, so that a damped Newton
/// method creeps along it, while a polynomial bends with it. It allocates, and is a last attempt.
///
/// T: scalar of the step; parts are fractions of the whole step in (0, 1].
#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <utility>
#include <vector>

namespace extremal {

template <class T>
class StepContinuation {
public:
    using Vector = Eigen::Matrix<T, Eigen::Dynamic, 1>;

    /// `solve(part, isFresh)` solves the step of that part of the whole length, from a starting value of its
    /// own (isFresh) or from Y, and leaves the solution in Y; false: it failed. Whether the whole step is
    /// solved.
    template <class Solve>
    bool follow(Vector& Y, Solve&& solve) {
        solved_.assign(1, {T(0), Vector::Zero(Y.size())});
        T length = T(0.5);
        for (int attempts = 0; attempts < mostAttempts && length > T(shortest); ++attempts) {
            const bool isFresh = solved_.size() == 1;
            const T from = solved_.back().first, part = std::min(T(1), T(from + length));
            if (!isFresh) predict(part, Y);
            if (!solve(part, isFresh)) {
                length /= T(2);
                continue;
            }
            if (part == T(1)) return true;
            if (solved_.size() == mostPoints) solved_.erase(solved_.begin());
            solved_.push_back({part, Y});
            length *= T(1.5);
        }
        return false;
    }

private:
    /// Where this many attempts do not arrive, a step of this length is not one to be made.
    static constexpr int mostAttempts = 100;
    static constexpr double shortest = 1e-4;
    /// A polynomial of degree 4 bends enough; higher ones swing.
    static constexpr std::size_t mostPoints = 5;

    /// The polynomial through the solutions so far, at another part of the step (Neville).
    void predict(const T& part, Vector& Y) const {
        std::vector<Vector> values;
        for (const auto& [at, value] : solved_) values.push_back(value);
        for (std::size_t span = 1; span < values.size(); ++span)
            for (std::size_t i = 0; i + span < values.size(); ++i) {
                const T a = solved_[i].first, b = solved_[i + span].first;
                values[i] = ((part - a) * values[i + 1] + (b - part) * values[i]) / (b - a);
            }
        Y = values.front();
    }

    std::vector<std::pair<T, Vector>> solved_;  ///< (part, Y), the last ones
};

}  // namespace extremal
