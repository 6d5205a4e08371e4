// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/group/named_groups.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "engine/core/problem.hpp"
#include "engine/core/text/expression.hpp"
#include "engine/core/text/number_in.hpp"
#include "engine/core/text/text.hpp"

namespace extremal::groups {
namespace {

using Square = MatrixGroup::Square;
using Basis = std::vector<Square>;

/// A matrix of size n with these entries (row, column, value), counted from 1.
struct Cell {
    int row, column;
    double value;
};
Square with(int n, std::initializer_list<Cell> cells) {
    Square m = Square::Zero(n, n);
    for (const Cell& c : cells) m(c.row - 1, c.column - 1) = c.value;
    return m;
}

/// From axis a to axis b.
Square rotation(int n, int a, int b) { return with(n, {{b, a, 1}, {a, b, -1}}); }

/// -i sigma_k / 2 as (re -im; im re).
Basis su2() {
    const Square re[] = {with(2, {}), with(2, {{1, 2, -0.5}, {2, 1, 0.5}}), with(2, {})};
    const Square im[] = {with(2, {{1, 2, -0.5}, {2, 1, -0.5}}), with(2, {}),
                         with(2, {{1, 1, -0.5}, {2, 2, 0.5}})};
    Basis basis;
    for (int k = 0; k < 3; ++k) {
        Square E(4, 4);
        E << re[k], -im[k], im[k], re[k];
        basis.push_back(E);
    }
    return basis;
}

const std::vector<std::pair<std::string, Basis>>& all() {
    static const std::vector<std::pair<std::string, Basis>> table{
        {"so3", {rotation(3, 2, 3), rotation(3, 3, 1), rotation(3, 1, 2)}},
        {"so4",
         {rotation(4, 1, 2), rotation(4, 1, 3), rotation(4, 1, 4), rotation(4, 2, 3), rotation(4, 2, 4),
          rotation(4, 3, 4)}},
        {"su2", su2()},
        {"sl2", {with(2, {{1, 1, 1}, {2, 2, -1}}), with(2, {{1, 2, 1}}), with(2, {{2, 1, 1}})}},
        {"se2", {rotation(3, 1, 2), with(3, {{1, 3, 1}}), with(3, {{2, 3, 1}})}},
        {"se3",
         {rotation(4, 2, 3), rotation(4, 3, 1), rotation(4, 1, 2), with(4, {{1, 4, 1}}), with(4, {{2, 4, 1}}),
          with(4, {{3, 4, 1}})}},
        {"heisenberg", {with(3, {{1, 2, 1}}), with(3, {{2, 3, 1}}), with(3, {{1, 3, 1}})}},
        {"so21", {with(3, {{2, 3, 1}, {3, 2, 1}}), with(3, {{1, 3, 1}, {3, 1, 1}}), rotation(3, 1, 2)}},
        {"u1", {rotation(2, 1, 2)}}};
    return table;
}

std::string groupChoices() {
    return joinNames(names()) + ", {\"basis\": [matrix, ..]} or {\"product\": {\"name\": group, ..}}";
}

Square basisMatrix(const Value& given, const std::string& pointer, int n) {
    if (!given.isObject()) return matrixOf(given, pointer, n);
    const Value *const real = given.find("re"), *const imaginary = given.find("im");
    if (!real || !imaginary || given.asObject().size() != 2)
        throw InvalidScene(pointer, "must be the rows of a matrix, or {\"re\": rows, \"im\": rows}",
                           "both parts of a complex matrix, of the same size");
    const Square re = matrixOf(*real, pointer + "/re", n / 2);
    const auto size = static_cast<int>(re.rows());
    if (2 * size > GroupFactor::maxSize)
        throw InvalidScene(pointer,
                           "is complex and has " + std::to_string(size) +
                               " rows, which are twice as many real ones; the limit is " +
                               std::to_string(GroupFactor::maxSize),
                           "a smaller representation");
    const Square im = matrixOf(*imaginary, pointer + "/im", size);
    Square E(2 * size, 2 * size);
    E << re, -im, im, re;
    return E;
}

MatrixGroup::Definition factorOf(const Value& given, const std::string& name, const std::string& pointer) {
    if (given.isString()) {
        const Basis basis = basisOf(given.asString());
        if (basis.empty())
            throw InvalidScene(pointer, "there is no group \"" + given.asString() + "\"",
                               suggestName(given.asString(), names()));
        return {name, basis, pointer};
    }
    const Value* const matrices = given.isObject() ? given.find("basis") : nullptr;
    if (!matrices || !matrices->isArray() || matrices->asArray().empty() || given.asObject().size() != 1)
        throw InvalidScene(pointer, "is not a group", groupChoices());
    MatrixGroup::Definition made{name, {}, pointer + "/basis"};
    for (const Value& matrix : matrices->asArray()) {
        const std::string place = made.pointer + "/" + std::to_string(made.basis.size());
        const int n = made.basis.empty() ? 0 : static_cast<int>(made.basis[0].rows());
        made.basis.push_back(basisMatrix(matrix, place, n));
    }
    return made;
}

}  // namespace

std::vector<std::string> names() {
    std::vector<std::string> result;
    for (const auto& [name, basis] : all()) result.push_back(name);
    return result;
}

Basis basisOf(const std::string& name) {
    const auto found =
        std::find_if(all().begin(), all().end(), [&](const auto& each) { return each.first == name; });
    return found == all().end() ? Basis{} : found->second;
}

Square matrixOf(const Value& given, const std::string& pointer, int n) {
    const auto refuse = [&](const std::string& what) {
        throw InvalidScene(pointer, what,
                           n > 0 ? std::to_string(n) + " rows of " + std::to_string(n) + " numbers each"
                                 : "rows of numbers, as many as each has numbers");
    };
    if (!given.isArray() || given.asArray().empty()) refuse("must be a matrix, given by its rows");
    const auto size = static_cast<int>(given.asArray().size());
    if (n > 0 && size != n) refuse("has " + std::to_string(size) + " rows");
    if (size > GroupFactor::maxSize)
        throw InvalidScene(
            pointer,
            "has " + std::to_string(size) + " rows; the limit is " + std::to_string(GroupFactor::maxSize),
            "a smaller representation, or a product of groups");
    Square m(size, size);
    for (int i = 0; i < size; ++i) {
        const Value& row = given.asArray()[static_cast<std::size_t>(i)];
        if (!row.isArray() || static_cast<int>(row.asArray().size()) != size)
            refuse("is not square: row " + std::to_string(i + 1) + " has not " + std::to_string(size) +
                   " numbers");
        for (int j = 0; j < size; ++j)
            m(i, j) = numberIn(row.asArray()[static_cast<std::size_t>(j)],
                               pointer + "/" + std::to_string(i) + "/" + std::to_string(j), {});
    }
    return m;
}

MatrixGroup groupOf(const Value& given) {
    const Value* const product = given.isObject() ? given.find("product") : nullptr;
    if (!product) return MatrixGroup({factorOf(given, "", "/group")});
    if (!product->isObject() || product->asObject().empty() || given.asObject().size() != 1)
        throw InvalidScene("/group/product", "must be an object of groups by name",
                           "{\"upper\": \"so3\", \"lower\": \"so3\"}, say");
    std::vector<MatrixGroup::Definition> factors;
    std::set<std::string> names;
    for (const auto& [name, factor] : product->asObject()) {
        const std::string pointer = "/group/product/" + name;
        if (const std::string problem = nameProblem(name); !problem.empty())
            throw InvalidScene(pointer, "the name \"" + name + "\" " + problem, "another name");
        if (!names.insert(name).second)
            throw InvalidScene(pointer, "the name \"" + name + "\" is given twice",
                               "every factor has a name of its own");
        factors.push_back(factorOf(factor, name, pointer));
    }
    return MatrixGroup(factors);
}

}  // namespace extremal::groups
