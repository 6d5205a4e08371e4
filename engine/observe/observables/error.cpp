// SPDX-License-Identifier: GPL-3.0-or-later
/// Error against the reference at the node's own t, by the system's measure: |q - q_ref|, |p - p_ref|
/// (Euclidean) and q_i - q_ref,i of each coordinate, signed; the angle between two attitudes for bodies;
/// the nodal L2 norm of fields, and at rows the L2 norm of the interpolating function.
#include "engine/observe/catalog.hpp"

namespace extremal::observables {

ObservableEntry error() {
    ObservableEntry e;
    e.item = {
        "error",
        "error",
        "Distance from the reference solution: |q - q_ref|, |p - p_ref| and each coordinate; of fields in "
        "the nodal L2 norm, and (error.function) that of the interpolating function.",
        {},
        {},
        "a reference"};
    e.needsReference = true;
    e.takes = Takes::everything();
    e.bind = [](const ObserveContext& context) {
        const ErrorMeasure measure = errorMeasure(context.system, context.initial);
        Observer o;
        for (const Quantity& c : measure.columns) o.columns.push_back({c.name, c.symbol, c.unit, {}, {}});
        o.extreme = 0;
        const bool isUsual = !context.system.error.evaluate;
        if (measure.ofFunction && context.reference.atPlaces()) {
            o.rowColumns = {{"error.function", "‖u_h - u_ref‖", "", {}, {}}};
            o.evaluateRow = [ofFunction = measure.ofFunction, reference = context.reference](
                                double t, const double* x, double* values) {
                values[0] = ofFunction(t, x, reference);
            };
        }
        if (measure.evaluateField && context.reference.atPlaces()) {
            o.evaluate = [reference = context.reference, evaluate = measure.evaluateField](
                             const NodeBlock& nodes, double* values, std::size_t stride) {
                for (std::size_t i = 0; i < nodes.size(); ++i, values += stride)
                    evaluate(nodes.t(i), nodes.x(i), reference, values);
            };
            return o;
        }
        o.evaluate = [reference = context.reference, evaluate = measure.evaluate, isUsual,
                      d = context.system.coordinates.size(), width = context.initial.x.size(),
                      exact = std::vector<double>()](const NodeBlock& nodes, double* values,
                                                     std::size_t stride) mutable {
            exact.resize(width * nodes.size());
            reference(nodes.times(), exact.data(), width);
            const double* y = exact.data();
            for (std::size_t i = 0; i < nodes.size(); ++i, values += stride, y += width)
                if (isUsual)
                    coordinateError(d, nodes.x(i), y, values);
                else
                    evaluate(nodes.x(i), y, values);
        };
        return o;
    };
    return e;
}

}  // namespace extremal::observables
