// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/tableau/order_conditions.hpp"

#include <algorithm>
#include <memory>
#include <utility>

namespace extremal {
namespace {

enum class Colour { f, g };

struct Tree {
    Colour colour = Colour::f;
    std::vector<std::size_t> children;  ///< places in the list of all, ascending
    int nodes = 1, gamma = 1;
    Tableau::Vector phi;  ///< at the stages of its colour
};

class Trees {
public:
    Trees(const Tableau& tableau, TreeKind kind, int most) : tableau_(tableau), kind_(kind) {
        for (int order = 1; order <= most; ++order) {
            const std::size_t known = all_.size();
            for (const Colour colour : {Colour::f, Colour::g}) {
                if (kind == TreeKind::plain && colour == Colour::g) continue;
                std::vector<std::size_t> children;
                grow(colour, order - 1, 0, known, children);
            }
        }
    }
    const std::vector<Tree>& all() const { return all_; }

    std::string text(const Tree& tree) const {
        const char letter = tree.colour == Colour::f ? 'f' : 'g';
        const std::size_t n = tree.children.size();
        std::string result(1, letter);
        if (n == 0) return result;
        if (n <= 3)
            result.append(n, '\'');
        else
            result += "^(" + std::to_string(n) + ")";
        result += '(';
        for (std::size_t k = 0; k < n; ++k)
            result.append(k > 0 ? ", " : "").append(text(all_[tree.children[k]]));
        return result + ")";
    }

private:
    bool mayHave(Colour parent, Colour child) const {
        if (kind_ == TreeKind::separable || kind_ == TreeKind::quadraticKinetic) return parent != child;
        return true;
    }
    /// Adds all trees whose children have `left` nodes more than those chosen so far, from place `from` on.
    void grow(Colour colour, int left, std::size_t from, std::size_t known,
              std::vector<std::size_t>& children) {
        if (left == 0) return add(colour, children);
        if (kind_ == TreeKind::quadraticKinetic && colour == Colour::f && !children.empty()) return;
        for (std::size_t k = from; k < known; ++k) {
            if (all_[k].nodes > left || !mayHave(colour, all_[k].colour)) continue;
            children.push_back(k);
            grow(colour, left - all_[k].nodes, k, known, children);
            children.pop_back();
        }
    }
    void add(Colour colour, const std::vector<std::size_t>& children) {
        Tree tree;
        tree.colour = colour;
        tree.children = children;
        const bool isF = colour == Colour::f;
        tree.phi = Tableau::Vector::Ones(isF ? tableau_.velocities() : tableau_.forces());
        for (const std::size_t k : children) {
            const Tree& child = all_[k];
            tree.nodes += child.nodes;
            tree.gamma *= child.gamma;
            // Velocities move q, forces p.
            const Tableau::Matrix& moved = child.colour == Colour::f ? tableau_.A : tableau_.Ahat;
            tree.phi = tree.phi.cwiseProduct(moved * child.phi).eval();
        }
        tree.gamma *= tree.nodes;
        all_.push_back(std::move(tree));
    }

    const Tableau& tableau_;
    TreeKind kind_;
    std::vector<Tree> all_;
};

}  // namespace

std::vector<OrderCondition> orderConditions(const Tableau& tableau, TreeKind kind, int most) {
    const Trees trees(tableau, kind, most);
    std::vector<OrderCondition> conditions;
    for (const Tree& tree : trees.all()) {
        const Tableau::Vector& weight = tree.colour == Colour::f ? tableau.b : tableau.bHat;
        conditions.push_back(
            {trees.text(tree), tree.nodes, tree.gamma, weight.dot(tree.phi) - Quad(1) / tree.gamma});
    }
    return conditions;
}

TreeKind treesFor(const Tableau& tableau) {
    switch (tableau.scope) {
        case TableauScope::any:
            return tableau.isPlain() ? TreeKind::plain : TreeKind::all;
        case TableauScope::separable:
            return TreeKind::separable;
        case TableauScope::quadraticKinetic:
            return TreeKind::quadraticKinetic;
    }
    return TreeKind::all;
}

int orderOf(const std::vector<OrderCondition>& conditions, double known) {
    int order = 0;
    for (const OrderCondition& condition : conditions) order = std::max(order, condition.order);
    for (const OrderCondition& condition : conditions)
        if (abs(condition.residual) > 1e3 * known) order = std::min(order, condition.order - 1);
    return order;
}

}  // namespace extremal
