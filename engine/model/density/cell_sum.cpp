// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/density/cell_sum.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "engine/model/plane_field/joint_potential.hpp"

namespace extremal {
namespace {

constexpr int mostComponents = static_cast<int>(JointPotential::mostComponents),
              mostArguments = 4 * mostComponents;

}  // namespace

std::vector<double> DensityProblem::x() const {
    std::vector<double> places;
    for (int i = 0; i < nodesX(); ++i) places.push_back(placeX(i));
    return places;
}

std::vector<double> DensityProblem::y() const {
    std::vector<double> places;
    for (int j = 0; isPlane() && j < nodesY(); ++j) places.push_back(placeY(j));
    return places;
}

/// Functions of space N_n at the nodes of a rule; in time u is `atFirst` a + `atSecond` b, and u_t is
/// `rateOfFirst` a + `rateOfSecond` b.
void CellSum::addNodes(const Rule<double>& space, double weight, double t, double atFirst, double atSecond,
                       double rateOfFirst, double rateOfSecond) {
    const double dx = problem_->dx(), dy = problem_->dy();
    const bool isPlane = problem_->isPlane();
    const std::size_t across = isPlane ? space.c.size() : 1;
    for (std::size_t j = 0; j < across; ++j)
        for (std::size_t i = 0; i < space.c.size(); ++i) {
            Node node;
            const double xi = space.c[i], eta = isPlane ? space.c[j] : 0;
            node.weight = weight * dx * space.b[i] * (isPlane ? dy * space.b[j] : 1);
            node.x = xi * dx;
            node.y = eta * dy;
            node.t = t;
            for (int n = 0; n < corners(); ++n) {
                const bool isRight = n % 2 == 1, isUpper = n / 2 == 1;
                const double X = isRight ? xi : 1 - xi,
                             Y = !isPlane  ? 1
                                 : isUpper ? eta
                                           : 1 - eta,
                             slopeX = (isRight ? 1 : -1) / dx, slopeY = (isUpper ? 1 : -1) / dy;
                for (const auto& [which, at, rate] :
                     {std::tuple{0, atFirst, rateOfFirst}, std::tuple{1, atSecond, rateOfSecond}}) {
                    double* const factor = node.factor[which][n];
                    factor[DensityArgument::value] = at * X * Y;
                    factor[DensityArgument::velocity] = rate * X * Y;
                    factor[DensityArgument::slopeX] = at * slopeX * Y;
                    factor[DensityArgument::slopeY] = isPlane ? at * X * slopeY : 0;
                }
            }
            nodes_.push_back(node);
        }
}

CellSum CellSum::ofInstant(std::shared_ptr<const DensityProblem> problem, const Rule<double>& space) {
    CellSum sum(std::move(problem));
    sum.addNodes(space, 1, 0, 1, 0, 0, 1);
    return sum;
}

CellSum CellSum::ofSlab(std::shared_ptr<const DensityProblem> problem, const Rule<double>& space,
                        const Rule<double>& time, double h) {
    CellSum sum(std::move(problem));
    sum.isSlab_ = true;
    for (std::size_t b = 0; b < time.c.size(); ++b)
        sum.addNodes(space, h * time.b[b], h * time.c[b], 1 - time.c[b], time.c[b], -1 / h, 1 / h);
    return sum;
}

long long CellSum::evaluations() const {
    return static_cast<long long>(problem_->cellsX) * problem_->cellsY *
           static_cast<long long>(nodes_.size());
}

template <class F>
void CellSum::sweep(double t, const double* a, const double* b, F&& f) const {
    const DensityProblem& p = *problem_;
    const int m = static_cast<int>(p.components()), kinds = p.density.kinds(), nx = p.nodesX(),
              ny = p.nodesY();
    const std::size_t stride = p.nodes();
    std::array<double, mostArguments + 3> at;
    std::array<std::size_t, mostCorners> corner{};
    for (int j = 0; j < p.cellsY; ++j)
        for (int i = 0; i < p.cellsX; ++i) {
            for (int n = 0; n < corners(); ++n)
                corner[static_cast<std::size_t>(n)] =
                    static_cast<std::size_t>((i + n % 2) % nx + (j + n / 2) % ny * nx);
            for (const Node& node : nodes_) {
                for (int c = 0; c < m; ++c) {
                    const double *const A = a + static_cast<std::size_t>(c) * stride,
                                        *const B = b + static_cast<std::size_t>(c) * stride;
                    for (int k = 0; k < kinds; ++k) {
                        double sum = 0;
                        for (int n = 0; n < corners(); ++n) {
                            const std::size_t place = corner[static_cast<std::size_t>(n)];
                            const double first = node.factor[0][n][k], next = node.factor[1][n][k];
                            // Of neighbouring levels by their difference, which is exact.
                            sum += isSlab_ ? (first + next) * A[place] + next * (B[place] - A[place])
                                           : first * A[place] + next * B[place];
                        }
                        at[static_cast<std::size_t>(k * m + c)] = sum;
                    }
                }
                auto last = static_cast<std::size_t>(m * kinds);
                at[last++] = p.placeX(i) + node.x;
                if (p.isPlane()) at[last++] = p.placeY(j) + node.y;
                at[last] = t + node.t;
                f(node, corner, at.data());
            }
        }
}

double CellSum::value(double t, const double* a, const double* b) const {
    double sum = 0;
    sweep(t, a, b, [&](const Node& node, const auto&, const double* at) {
        sum += node.weight * problem_->density.value(at);
    });
    return sum;
}

double CellSum::energy(double t, const double* a, const double* b) const {
    double sum = 0;
    std::array<double, mostArguments> slope;
    const int m = problem_->density.components();
    sweep(t, a, b, [&](const Node& node, const auto&, const double* at) {
        double density = -problem_->density.gradient(at, slope.data());
        for (int c = m; c < 2 * m; ++c) density += slope[static_cast<std::size_t>(c)] * at[c];
        sum += node.weight * density;
    });
    return sum;
}

double CellSum::momentum(double t, const double* a, const double* b, int direction) const {
    double sum = 0;
    std::array<double, mostArguments> slope;
    const int m = problem_->density.components();
    sweep(t, a, b, [&](const Node& node, const auto&, const double* at) {
        (void)problem_->density.gradient(at, slope.data());
        for (int c = 0; c < m; ++c)
            sum -= node.weight * slope[static_cast<std::size_t>(m + c)] * at[(2 + direction) * m + c];
    });
    return sum;
}

void CellSum::addGradient(double t, const double* a, const double* b, By by, double* slope) const {
    std::array<double, mostArguments> of;
    const int m = problem_->density.components(), kinds = problem_->density.kinds();
    const std::size_t stride = problem_->nodes();
    sweep(t, a, b, [&](const Node& node, const auto& corner, const double* at) {
        (void)problem_->density.gradient(at, of.data());
        const auto& factor = node.factor[by == By::first ? 0 : 1];
        for (int n = 0; n < corners(); ++n)
            for (int c = 0; c < m; ++c) {
                double sum = 0;
                for (int k = 0; k < kinds; ++k) sum += factor[n][k] * of[static_cast<std::size_t>(k * m + c)];
                slope[corner[static_cast<std::size_t>(n)] + static_cast<std::size_t>(c) * stride] +=
                    node.weight * sum;
            }
    });
}

void CellSum::addHessian(double t, const double* a, const double* b, By row, By column,
                         const Add& add) const {
    std::array<double, mostArguments> of;
    std::array<double, mostArguments*(mostArguments + 1) / 2> second;
    const int m = problem_->density.components(), kinds = problem_->density.kinds();
    const std::size_t stride = problem_->nodes();
    const auto entry = [&](int i, int j) {
        return second[static_cast<std::size_t>(i >= j ? i * (i + 1) / 2 + j : j * (j + 1) / 2 + i)];
    };
    sweep(t, a, b, [&](const Node& node, const auto& corner, const double* at) {
        (void)problem_->density.jet(at, of.data(), second.data());
        const auto &left = node.factor[row == By::first ? 0 : 1],
                   &right = node.factor[column == By::first ? 0 : 1];
        for (int n = 0; n < corners(); ++n)
            for (int l = 0; l < corners(); ++l)
                for (int c = 0; c < m; ++c)
                    for (int d = 0; d < m; ++d) {
                        double sum = 0;
                        for (int k = 0; k < kinds; ++k)
                            for (int r = 0; r < kinds; ++r)
                                sum += left[n][k] * entry(k * m + c, r * m + d) * right[l][r];
                        add(corner[static_cast<std::size_t>(n)] + static_cast<std::size_t>(c) * stride,
                            corner[static_cast<std::size_t>(l)] + static_cast<std::size_t>(d) * stride,
                            node.weight * sum);
                    }
    });
}

}  // namespace extremal
