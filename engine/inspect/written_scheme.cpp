// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/inspect/written_scheme.hpp"

#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"
#include "engine/family/table_of.hpp"
#include "engine/quadrature/tensor.hpp"
#include "engine/scene/resolve.hpp"

namespace extremal {

WrittenScheme writtenScheme(const SchemeSpec& scheme) {
    WrittenScheme written;
    try {
        const ResolvedScheme resolved = resolve(scheme);
        const Discretization* const plain = resolved.plain();
        if (!plain || isTermRule(plain->quadrature) || !hasTable(*plain)) return written;
        const Table<double> table = tableOf(plain->space, plain->quadrature);
        // As many functions as the polynomials of its degree, all of which it has: it is theirs.
        if (table.space.size == table.space.degree + 1 && !plain->space.find("functions")) {
            written.hasFunctions = true;
            written.functions = "1\ntau";
            for (int power = 2; power <= table.space.degree; ++power)
                written.functions += "\ntau^" + std::to_string(power);
        }
        written.hasNodes = true;
        written.nodes.clear();
        for (int i = 0; i < table.nodes(); ++i) {
            const char* const end = i + 1 < table.nodes() ? "\n" : "";
            written.nodes += formatNumber(table.node(i)) + end;
            written.weights += formatNumber(table.weight(i)) + end;
        }
    } catch (const InvalidScene&) {  // an example will do
    }
    return written;
}

}  // namespace extremal
