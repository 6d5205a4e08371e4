// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/density/cell_sum.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "engine/core/algebra/instruction_set.hpp"
#include "engine/model/plane_field/joint_potential.hpp"

namespace extremal {
namespace {

constexpr int mostComponents = static_cast<int>(JointPotential::mostComponents),
              mostArguments = 4 * mostComponents;

/// A function along an axis at a place of a cell, 0 to 1.
struct AxisFunction {
    double value, slope;
};

/// That of the corner at the left or the right; what is constant belongs to the left one.
AxisFunction axisFunction(double xi, double length, bool isRight, bool isConstant) {
    if (isConstant) return {isRight ? 0.0 : 1.0, 0};
    return isRight ? AxisFunction{xi, 1 / length} : AxisFunction{1 - xi, -1 / length};
}

}  // namespace

std::vector<double> DensityProblem::x() const {
    std::vector<double> all;
    for (int i = 0; i < nodesX(); ++i) all.push_back(placeX(i));
    return all;
}

std::vector<double> DensityProblem::y() const {
    std::vector<double> all;
    for (int j = 0; isPlane() && j < nodesY(); ++j) all.push_back(placeY(j));
    return all;
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
            for (int place = 0; place < placesOfValues; ++place)
                for (int n = 0; n < corners(); ++n) {
                    const auto of = static_cast<FieldPlace>(place);
                    const AxisFunction X = axisFunction(xi, dx, n % 2 == 1, isConstantAlong(of, 0)),
                                       Y = isPlane ? axisFunction(eta, dy, n / 2 == 1, isConstantAlong(of, 1))
                                                   : AxisFunction{1, 0};
                    for (const auto& [which, at, rate] :
                         {std::tuple{0, atFirst, rateOfFirst}, std::tuple{1, atSecond, rateOfSecond}}) {
                        double* const factor = node.factor[place][which][n];
                        factor[DensityArgument::value] = at * X.value * Y.value;
                        factor[DensityArgument::velocity] = rate * X.value * Y.value;
                        factor[DensityArgument::slopeX] = at * X.slope * Y.value;
                        factor[DensityArgument::slopeY] = at * X.value * Y.slope;
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

CellSum::Corners CellSum::cornersOf(int i, int j) const {
    const int nx = problem_->nodesX(), ny = problem_->nodesY();
    Corners corner{};
    for (int n = 0; n < corners(); ++n)
        corner[static_cast<std::size_t>(n)] =
            static_cast<std::size_t>((i + n % 2) % nx + (j + n / 2) % ny * nx);
    return corner;
}

template <class F>
void CellSum::sweep(double t, const double* a, const double* b, F&& f) const {
    const DensityProblem& p = *problem_;
    const int m = static_cast<int>(p.components()), kinds = p.density.kinds();
    const std::size_t stride = p.nodes();
    std::array<double, mostArguments + 3> at;
    for (int j = 0; j < p.cellsY; ++j)
        for (int i = 0; i < p.cellsX; ++i) {
            const Corners corner = cornersOf(i, j);
            for (const Node& node : nodes_) {
                for (int c = 0; c < m; ++c) {
                    const double *const A = a + static_cast<std::size_t>(c) * stride,
                                        *const B = b + static_cast<std::size_t>(c) * stride;
                    const Factors& factor = factors(node, static_cast<std::size_t>(c));
                    for (int k = 0; k < kinds; ++k) {
                        double sum = 0;
                        for (int n = 0; n < corners(); ++n) {
                            const std::size_t place = corner[static_cast<std::size_t>(n)];
                            const double first = factor[0][n][k], next = factor[1][n][k];
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

/// Eight cells of a row: the values at their corners, and what the sum adds to its derivatives by them.
struct CellSum::Block {
    Lanes a[mostComponents][mostCorners], b[mostComponents][mostCorners], slope[mostComponents][mostCorners];
    Lanes x;  ///< the left corners
    double y = 0, t = 0;
};

void CellSum::addBlock(const CellSum* sum, int by, Block* block) {
    const DensityProblem& p = *sum->problem_;
    const auto m = p.components(), kinds = static_cast<std::size_t>(p.density.kinds());
    const int corners = sum->corners();
    Lanes at[mostArguments + 3], of[mostArguments];
    for (const Node& node : sum->nodes_) {
        for (std::size_t c = 0; c < m; ++c) {
            const Factors& factor = sum->factors(node, c);
            for (std::size_t k = 0; k < kinds; ++k) {
                Lanes value(0.0);
                for (int n = 0; n < corners; ++n) {
                    const double first = factor[0][n][k], next = factor[1][n][k],
                                 own = sum->isSlab_ ? first + next : first;
                    if (own != 0) value += own * block->a[c][n];
                    if (next != 0) value += next * block->b[c][n];
                }
                at[k * m + c] = value;
            }
        }
        std::size_t last = m * kinds;
        at[last] = block->x + node.x;
        if (p.isPlane()) at[++last] = block->y + node.y;
        at[++last] = block->t + node.t;
        p.density.gradient(at, of);
        for (std::size_t c = 0; c < m; ++c) {
            const auto& factor = sum->factors(node, c)[by];
            for (int n = 0; n < corners; ++n)
                for (std::size_t k = 0; k < kinds; ++k)
                    if (factor[n][k] != 0) block->slope[c][n] += (node.weight * factor[n][k]) * of[k * m + c];
        }
    }
}

/// Eight cells of a row together; the last ones of a row more than once, where it does not come out even.
void CellSum::addGradient(double t, const double* a, const double* b, By by, double* slope) const {
    static const auto addOneBlock = ForThisMachine<&CellSum::addBlock>::call();
    const DensityProblem& p = *problem_;
    constexpr int eight = Lanes::size;
    const std::size_t stride = p.nodes();
    Block block;
    block.t = t;
    std::array<Corners, eight> corner;
    for (int j = 0; j < p.cellsY; ++j)
        for (int first = 0; first < p.cellsX; first += eight) {
            const int count = std::min(eight, p.cellsX - first);
            for (std::size_t l = 0; l < eight; ++l) {
                const int i = first + std::min(static_cast<int>(l), count - 1);
                corner[l] = cornersOf(i, j);
                block.x.lane[l] = p.placeX(i);
            }
            if (p.isPlane()) block.y = p.placeY(j);
            for (std::size_t c = 0; c < p.components(); ++c)
                for (int n = 0; n < corners(); ++n) {
                    block.slope[c][n] = Lanes(0.0);
                    for (std::size_t l = 0; l < eight; ++l) {
                        const std::size_t place = c * stride + corner[l][static_cast<std::size_t>(n)];
                        block.a[c][n].lane[l] = a[place];
                        // Of neighbouring levels by their difference, which is exact.
                        block.b[c][n].lane[l] = isSlab_ ? b[place] - a[place] : b[place];
                    }
                }
            addOneBlock(this, by == By::first ? 0 : 1, &block);
            for (std::size_t c = 0; c < p.components(); ++c)
                for (int n = 0; n < corners(); ++n)
                    for (std::size_t l = 0; l < static_cast<std::size_t>(count); ++l)
                        slope[c * stride + corner[l][static_cast<std::size_t>(n)]] +=
                            block.slope[c][n].lane[l];
        }
}

void CellSum::addMass(double* mass) const {
    const DensityProblem& p = *problem_;
    const int m = p.density.components();
    std::array<double, mostArguments> of;
    std::array<double, mostArguments*(mostArguments + 1) / 2> second;
    const std::vector<double> zero(p.size(), 0.0);
    sweep(0, zero.data(), zero.data(), [&](const Node& node, const auto& corner, const double* at) {
        (void)p.density.jet(at, of.data(), second.data());
        for (int c = 0; c < m; ++c) {
            const auto i = static_cast<std::size_t>(m + c);
            const Factors& factor = factors(node, static_cast<std::size_t>(c));
            for (int n = 0; n < corners(); ++n) {
                const double share = factor[1][n][DensityArgument::velocity];
                if (share != 0)
                    mass[corner[static_cast<std::size_t>(n)] + static_cast<std::size_t>(c) * p.nodes()] +=
                        node.weight * share * share * second[i * (i + 1) / 2 + i];
            }
        }
    });
}

bool CellSum::forElements(double t, const double* u, const Element& f) const {
    const DensityProblem& p = *problem_;
    const auto m = static_cast<std::size_t>(p.components()),
               arguments = static_cast<std::size_t>(p.density.arguments());
    // The values of a cell: component, corner.
    std::vector<std::pair<std::size_t, int>> values;
    for (std::size_t c = 0; c < m; ++c)
        for (int n = 0; n < corners(); ++n)
            if ((n % 2 == 0 || !isConstantAlong(p.place(c), 0)) &&
                (n / 2 == 0 || !isConstantAlong(p.place(c), 1)))
                values.emplace_back(c, n);
    const auto size = static_cast<Eigen::Index>(values.size());
    Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(size, size), last;
    Eigen::VectorXd mass = Eigen::VectorXd::Zero(size), lastMass;
    std::array<double, mostArguments> of;
    std::array<double, mostArguments*(mostArguments + 1) / 2> second;
    const std::vector<double> rest(p.size(), 0.0);
    const bool isHomogeneous = p.density.isLinear() && !p.density.dependsOnPlace();
    bool isFine = true, isDone = false;
    std::size_t node = 0;
    sweep(t, u, rest.data(), [&](const Node& at, const auto&, const double* inputs) {
        if (!isFine || isDone) return;
        (void)p.density.jet(inputs, of.data(), second.data());
        const auto entry = [&](std::size_t i, std::size_t j) {
            return second[i >= j ? i * (i + 1) / 2 + j : j * (j + 1) / 2 + i];
        };
        for (Eigen::Index i = 0; i < size; ++i) {
            const auto [c, n] = values[static_cast<std::size_t>(i)];
            const auto& left = factors(at, c);
            const double share = left[1][n][DensityArgument::velocity];
            mass[i] += at.weight * share * share * entry(m + c, m + c);
            for (Eigen::Index j = 0; j < size; ++j) {
                const auto [d, l] = values[static_cast<std::size_t>(j)];
                const auto& right = factors(at, d);
                for (std::size_t a = c; a < arguments; a += m)
                    for (std::size_t b = d; b < arguments; b += m)
                        stiffness(i, j) -= at.weight * left[0][n][a / m] * entry(a, b) * right[0][l][b / m];
            }
        }
        if (++node % nodes_.size() != 0) return;
        if (mass.maxCoeff() < 0) {
            mass = -mass;
            stiffness = -stiffness;
        }
        isFine = mass.minCoeff() > 0 && mass.allFinite() && stiffness.allFinite();
        if (isFine && (last.size() == 0 || stiffness != last || mass != lastMass)) f(stiffness, mass);
        isDone = isHomogeneous;
        last.swap(stiffness);
        lastMass.swap(mass);
        stiffness.setZero(size, size);
        mass.setZero(size);
    });
    return isFine;
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
        for (int n = 0; n < corners(); ++n)
            for (int l = 0; l < corners(); ++l)
                for (int c = 0; c < m; ++c)
                    for (int d = 0; d < m; ++d) {
                        const auto &left =
                                       factors(node, static_cast<std::size_t>(c))[row == By::first ? 0 : 1],
                                   &right = factors(node,
                                                    static_cast<std::size_t>(d))[column == By::first ? 0 : 1];
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
