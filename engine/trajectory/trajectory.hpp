// SPDX-License-Identifier: GPL-3.0-or-later
/// Columns of samples of one run: t, the state, then the observables, at the sampled nodes.
///
/// column(c)[r] is row r of column c. All columns have the same length. An unknown value is NaN.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/text/archive.hpp"

namespace extremal {

struct Column {
    std::string name;    ///< CSV header: "q.theta", "energy_error"
    std::string symbol;  ///< for axis titles: "θ", "H - H(0)"
    std::string unit;    ///< "rad"; empty if dimensionless
    std::vector<double> values = {};
    std::vector<std::string> words =
        {};  ///< names of the values 0, 1, ... of a column that is a choice; empty for numbers
};

struct Trajectory {
    std::vector<Column> columns;  ///< columns[0] is t
    std::vector<double> nodes =
        {};  ///< steps done at each row, with a fraction inside a step; empty where not kept

    std::size_t rows() const { return columns.empty() ? 0 : columns.front().values.size(); }
    /// The column of that name, or null.
    const Column* find(std::string_view name) const {
        for (const Column& c : columns)
            if (c.name == name) return &c;
        return nullptr;
    }
    /// The values; columns are made before.
    void checkpoint(Archive& archive) {
        for (Column& c : columns) archive(c.values);
        archive(nodes);
    }
    /// The values of a column, empty if there is no such column.
    std::span<const double> operator[](std::string_view name) const {
        const Column* c = find(name);
        return c ? std::span<const double>(c->values) : std::span<const double>();
    }
};

}  // namespace extremal
