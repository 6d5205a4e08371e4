// SPDX-License-Identifier: GPL-3.0-or-later
/// Rows whose observers look at nodes on both sides (Observer::delay): their values are filled in when the
/// nodes behind them are known, and are unknown until then.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "engine/core/node_block.hpp"
#include "engine/core/text/archive.hpp"
#include "engine/trajectory/trajectory.hpp"

namespace extremal {

class DelayedRows {
public:
    struct Columns {
        std::size_t first, count;
        long long delay;  ///< 0: nothing waits
    };
    void add(const Columns& columns) {
        if (columns.delay > 0) columns_.push_back(columns);
    }
    /// The row of a node, which is to be recorded as number `row`.
    void wait(std::size_t row, long long node) {
        for (const Columns& each : columns_) waiting_.push_back({each, row, node + each.delay});
    }
    /// A row without the values that are not known yet.
    void blank(std::span<double> row) const {
        for (const Columns& each : columns_)
            std::fill_n(row.data() + each.first, each.count, std::numeric_limits<double>::quiet_NaN());
    }
    /// Values at the nodes of a block, `width` apart, into the rows that have waited for them.
    void fill(const NodeBlock& nodes, const double* values, std::size_t width, Trajectory& rows) {
        std::erase_if(waiting_, [&](const Waiting& each) {
            const long long at = each.node - nodes.node(0);
            if (at < 0 || at >= static_cast<long long>(nodes.size())) return false;
            const double* from = values + static_cast<std::size_t>(at) * width + each.columns.first;
            for (std::size_t c = 0; c < each.columns.count && each.row < rows.rows(); ++c)
                rows.columns[each.columns.first + c].values[each.row] = from[c];
            return true;
        });
    }
    void clear() { waiting_.clear(); }
    void checkpoint(Archive& archive) { archive(waiting_); }

private:
    struct Waiting {
        Columns columns;
        std::size_t row;
        long long node;
    };
    std::vector<Columns> columns_;
    std::vector<Waiting> waiting_;
};

}  // namespace extremal
