/// Error against the reference at the node's own t: |q - q_ref|, |p - p_ref| (Euclidean), and q_i - q_ref,i of each
/// coordinate, signed.
#include <cmath>

#include "engine/observe/catalog.hpp"

namespace extremal::observables {

ObservableEntry error() {
    ObservableEntry e;
    e.item = {"error", "error", "Distance from the reference solution: |q - q_ref|, |p - p_ref| and each coordinate.", {},
              {}, "a reference"};
    e.needsReference = true;
    e.bind = [](const ObserveContext& context) {
        Observer o;
        const auto& coordinates = context.system.coordinates;
        const std::size_t d = coordinates.size();
        bool sameUnit = true;
        for (const Coordinate& c : coordinates) sameUnit = sameUnit && c.unit == coordinates[0].unit;
        o.columns.push_back({"error", "|q - q_ref|", sameUnit ? coordinates[0].unit : "", {}, {}});
        o.columns.push_back({"error.p", "|p - p_ref|", sameUnit ? coordinates[0].momentumUnit : "", {}, {}});
        for (const Coordinate& c : coordinates)
            o.columns.push_back({"error." + c.name, c.symbol + " - " + c.symbol + "_ref", c.unit, {}});
        o.extreme = 0;
        o.evaluate = [reference = context.reference, d, exact = std::vector<double>()](
                         const NodeBlock& nodes, double* values, std::size_t stride) mutable {
            exact.resize(2 * d * nodes.size());
            reference(nodes.times(), exact.data(), 2 * d);
            const double* y = exact.data();
            for (std::size_t node = 0; node < nodes.size(); ++node, values += stride, y += 2 * d) {
                const double* x = nodes.x(node);
                double q = 0, p = 0;
                for (std::size_t i = 0; i < d; ++i) {
                    const double dq = x[i] - y[i], dp = x[d + i] - y[d + i];
                    values[2 + i] = dq;
                    q += dq * dq;
                    p += dp * dp;
                }
                values[0] = std::sqrt(q);
                values[1] = std::sqrt(p);
            }
        };
        return o;
    };
    return e;
}

}  // namespace extremal::observables
