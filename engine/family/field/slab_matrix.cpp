// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/family/field/slab_matrix.hpp"

#include <algorithm>
#include <set>
#include <utility>

namespace extremal {
namespace {

/// A row of C: z_first - z_second = 0, or z_first = a value where second is -1.
struct SlabTie {
    int first, second;
};

/// Rows and columns of the unknowns of a slab.
class SlabOrder {
public:
    SlabOrder(const FieldProblem& problem, const FieldCell& cell) : problem_(problem), cell_(cell) {
        const FieldNodes& nodes = problem.nodes;
        owner_.assign(static_cast<std::size_t>(nodes.size()), -1);
        add(nodes.size(), true, 0);  // p
        for (int e = 0; e < nodes.elements; ++e) {
            const std::vector<SlabTie> own = tiesOf(e);
            offset_.push_back(size_ + static_cast<int>(own.size()));
            for (std::size_t k = 0; k < own.size(); ++k)
                ties_.push_back({size_ + static_cast<int>(k), placeOf(own[k].first), placeOf(own[k].second)});
            if (!own.empty()) add(static_cast<int>(own.size()), true, e + 1);
            add(cell.unknowns(), false, e);
        }
        add(nodes.size(), true, nodes.elements + 1);  // p'
    }

    struct Tie {
        int row, first, second;
    };
    const std::vector<UnknownBlock>& blocks() const { return blocks_; }
    const std::vector<Tie>& ties() const { return ties_; }
    int size() const { return size_; }
    int offset(int e) const { return offset_[static_cast<std::size_t>(e)]; }
    /// The value of node i at level l, in the cell that it belongs to.
    int owned(int i, int l) const {
        const int owner = owner_[static_cast<std::size_t>(i)], width = cell_.spaceDegree() + 1;
        return offset(owner / width) + cell_.unknown(owner % width, l);
    }

private:
    void add(int size, bool isMultiplier, int index) {
        blocks_.push_back({size_, size, isMultiplier, index});
        size_ += size;
    }
    /// Unknowns of all cells, without the multipliers.
    int local(int e, int a, int l) const { return e * cell_.unknowns() + cell_.unknown(a, l); }
    int placeOf(int local) const {
        return local < 0 ? -1 : offset(local / cell_.unknowns()) + local % cell_.unknowns();
    }
    std::vector<SlabTie> tiesOf(int e) {
        std::vector<SlabTie> own;
        const int width = cell_.spaceDegree() + 1;
        for (int a = 0; a < width; ++a) {
            const int node = problem_.nodes.node(e, a);
            int& owner = owner_[static_cast<std::size_t>(node)];
            const bool isNew = owner < 0;
            if (isNew) owner = e * width + a;
            for (int l = 0; l <= cell_.timeDegree(); ++l) {
                if (!isNew)
                    own.push_back({local(e, a, l), local(owner / width, owner % width, l)});
                else if (problem_.isFixed(node) && l > 0)
                    own.push_back({local(e, a, l), -1});
            }
        }
        return own;
    }

    const FieldProblem& problem_;
    const FieldCell& cell_;
    std::vector<int> owner_, offset_;
    std::vector<UnknownBlock> blocks_;
    std::vector<Tie> ties_;
    int size_ = 0;
};

/// Of the value at a corner of cells in the middle: the cells it is in, and the other values there.
Supports supportsOfTents(int spaceDegree, int timeDegree) {
    Supports s;
    s.functions = (spaceDegree + 1) * (timeDegree + 1);
    s.isNodal = true;
    s.termsAtNode = 4;
    s.othersAtNode = (2 * spaceDegree + 1) * (2 * timeDegree + 1) - 1;
    s.othersInside = spaceDegree > 1 && timeDegree > 1 ? s.functions - 1 : 0;
    return s;
}

std::shared_ptr<const ElementFunctions> stretchOf(const ElementFunctions& all, std::size_t from,
                                                  std::size_t count) {
    ElementFunctions some;
    some.parts = all.parts;
    const auto parts = static_cast<std::size_t>(all.parts);
    const auto cut = [&](const std::vector<double>& v, std::size_t each) {
        const auto begin = v.begin() + static_cast<std::ptrdiff_t>(from * each);
        return std::vector<double>(begin, begin + static_cast<std::ptrdiff_t>(count * each));
    };
    some.phi = cut(all.phi, parts + 1);
    some.coefficient = cut(all.coefficient, parts);
    return std::make_shared<const ElementFunctions>(std::move(some));
}

}  // namespace

std::shared_ptr<const FieldProblem> stretchOf(const FieldProblem& problem, int from, int count) {
    FieldProblem some = problem;
    const auto begin = problem.mesh.x.begin() + from;
    some.mesh.x.assign(begin, begin + count + 1);
    some.nodes = FieldNodes(some.mesh, problem.nodes.degree);
    if (problem.functions)
        some.functions =
            stretchOf(*problem.functions, static_cast<std::size_t>(from), static_cast<std::size_t>(count));
    return std::make_shared<const FieldProblem>(std::move(some));
}

StepMatrix slabMatrix(const FieldProblem& problem, int timeDegree, const Rule<double>& space,
                      const Rule<double>& time, double step, const std::vector<double>& levels) {
    const FieldCell cell(problem, timeDegree, space, time);
    const SlabOrder order(problem, cell);
    const auto m = static_cast<std::size_t>(cell.unknowns());
    const int r = cell.spaceDegree(), n = problem.size();
    StepMatrix result;
    result.blocks = order.blocks();
    result.elements = problem.nodes.elements;
    result.dimension = 1;
    result.supports = supportsOfTents(r, timeDegree);
    Eigen::MatrixXd& A = result.magnitude = Eigen::MatrixXd::Zero(order.size(), order.size());
    std::vector<double> z(m), hessian(m * m);
    for (int e = 0; e < problem.nodes.elements; ++e) {
        for (int l = 0; l <= timeDegree; ++l)
            for (int a = 0; a <= r; ++a)
                z[static_cast<std::size_t>(cell.unknown(a, l))] =
                    levels[static_cast<std::size_t>(l * n + problem.nodes.node(e, a))];
        (void)cell.evaluate(e, step, z.data(), nullptr, hessian.data());
        A.block(order.offset(e), order.offset(e), cell.unknowns(), cell.unknowns()) =
            Eigen::Map<const Eigen::MatrixXd>(hessian.data(), cell.unknowns(), cell.unknowns()).cwiseAbs();
    }
    const auto tie = [&](int row, int column) { A(row, column) = A(column, row) = 1; };
    for (const SlabOrder::Tie& t : order.ties()) {
        tie(t.row, t.first);
        if (t.second >= 0) tie(t.row, t.second);
    }
    const int end = order.blocks().back().offset;
    for (int i = 0; i < n; ++i) {
        tie(i, order.owned(i, 0));
        tie(end + i, order.owned(i, timeDegree));
    }
    if (!A.allFinite()) result.failure = "the action of its first slab is not finite";
    return result;
}

}  // namespace extremal
