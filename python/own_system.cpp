// SPDX-License-Identifier: GPL-3.0-or-later
#include "python/own_system.hpp"

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <exception>
#include <limits>
#include <map>
#include <string>
#include <utility>

#include "extremal/own.hpp"

namespace py = pybind11;

namespace extremal::python {
namespace {

/// What a Lagrangian has thrown; with the lock of Python.
std::exception_ptr& failure() {
    static auto* const first = new std::exception_ptr;  // outlives the interpreter
    return *first;
}

/// derivatives(t, q, v, parameters) -> (L, gradient, Hessian), called with the lock of Python. Where it
/// throws, everything is NaN, and the run ends with the exception.
struct PythonLagrangian : api::LagrangianCalls {
    std::string id;
    py::object derivatives;
    py::dict parameters;

    PythonLagrangian(std::string name, int d, py::object call, py::dict values)
        : LagrangianCalls{d, &callJet, &callGradient},
          id(std::move(name)),
          derivatives(std::move(call)),
          parameters(std::move(values)) {}

    /// Numbers of a result, whose shape must be this one.
    using Array = py::array_t<double, py::array::c_style | py::array::forcecast>;
    Array shaped(const py::handle& given, const char* what, const std::vector<py::ssize_t>& wanted) const {
        const auto text = [](const auto& sizes) {
            std::string all;
            for (const py::ssize_t size : sizes) all += (all.empty() ? "(" : ", ") + std::to_string(size);
            return (all.empty() ? "(" : all) + (sizes.size() == 1 ? ",)" : ")");
        };
        const Array array = Array::ensure(given);
        if (!array) {
            PyErr_Clear();
            throw py::type_error("the Lagrangian of the system \"" + id + "\" gave a " + what +
                                 " that is not an array of numbers: " + py::repr(given).cast<std::string>());
        }
        const std::vector<py::ssize_t> found(array.shape(), array.shape() + array.ndim());
        if (found != wanted)
            throw py::value_error("the Lagrangian of the system \"" + id + "\" gave a " + what +
                                  " of shape " + text(found) + ", and " + std::to_string(dimension) +
                                  (dimension == 1 ? " coordinate needs " : " coordinates need ") +
                                  text(wanted));
        return array;
    }

    /// What it returned: (L, gradient, Hessian).
    void read(const py::object& result, double* value, double* gradient, double* hessian) const {
        const auto n = static_cast<std::size_t>(2 * dimension);
        const auto size = static_cast<py::ssize_t>(n);
        if (!py::isinstance<py::sequence>(result) || py::len(result) != 3)
            throw py::type_error("the Lagrangian of the system \"" + id +
                                 "\" must give (L, gradient, Hessian), got " +
                                 py::repr(result).cast<std::string>());
        const py::sequence all = result;
        const Array L = shaped(all[0], "value", {}), g = shaped(all[1], "gradient", {size}),
                    h = shaped(all[2], "Hessian", {size, size});
        *value = *L.data();
        std::copy_n(g.data(), n, gradient);
        if (hessian) std::copy_n(h.data(), n * n, hessian);
    }

    /// Adds to an exception of Python where it was thrown, which the traceback does not say.
    void note(py::error_already_set& error, double t, const py::list& q, const py::list& v) const {
        try {
            if (!py::hasattr(error.value(), "add_note")) return;  // before Python 3.11
            error.value().attr("add_note")("in the Lagrangian of the system \"" + id +
                                           "\" at t = " + py::repr(py::float_(t)).cast<std::string>() +
                                           ", q = " + py::repr(q).cast<std::string>() +
                                           ", v = " + py::repr(v).cast<std::string>());
        } catch (const py::error_already_set&) {  // the exception itself is what counts
        }
    }

    static void callJet(const LagrangianCalls* self, double t, const double* q, const double* v,
                        double* value, double* gradient, double* hessian) {
        const auto& own = *static_cast<const PythonLagrangian*>(self);
        const auto n = static_cast<std::size_t>(2 * own.dimension);
        const py::gil_scoped_acquire lock;
        py::list Q, V;
        try {
            for (int i = 0; i < own.dimension; ++i) {
                Q.append(q[i]);
                V.append(v[i]);
            }
            own.read(own.derivatives(t, Q, V, own.parameters), value, gradient, hessian);
        } catch (...) {
            try {
                throw;
            } catch (py::error_already_set& error) {
                if (!failure()) own.note(error, t, Q, V);
            } catch (const std::exception&) {  // its text has the place
            }
            if (!failure()) failure() = std::current_exception();
            constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
            *value = unknown;
            std::fill_n(gradient, n, unknown);
            if (hessian) std::fill_n(hessian, n * n, unknown);
        }
    }
    static void callGradient(const LagrangianCalls* self, double t, const double* q, const double* v,
                             double* gradient) {
        double value = 0;
        callJet(self, t, q, v, &value, gradient, nullptr);
    }
};

/// Objects of Python are released with its lock, whoever releases them.
std::shared_ptr<const api::LagrangianCalls> makeCalls(const std::string& id, int d, const py::object& call,
                                                      const std::vector<std::string>& names,
                                                      const api::Parameters& parameters) {
    const py::gil_scoped_acquire lock;
    py::dict values;
    for (const std::string& name : names) values[py::str(name)] = parameters[name];
    return {new PythonLagrangian(id, d, call, values), [](const api::LagrangianCalls* calls) {
                if (!Py_IsInitialized()) return;
                const py::gil_scoped_acquire held;
                delete static_cast<const PythonLagrangian*>(calls);
            }};
}

}  // namespace

void rethrowOfSystem() {
    if (failure()) std::rethrow_exception(std::exchange(failure(), nullptr));
}

void bindOwnSystem(py::module_& m) {
    m.def(
        "add_system",
        [](const std::string& id, const std::string& title, const std::string& description,
           const std::vector<std::string>& coordinates, const std::map<std::string, double>& parameters,
           bool isTimeDependent, const py::object& derivatives) {
            api::SystemInfo info{id, title, {}, {}, description, isTimeDependent};
            for (const std::string& name : coordinates) info.coordinates.push_back({name});
            std::vector<std::string> names;
            for (const auto& [name, value] : parameters) {
                info.parameters.push_back({name, value});
                names.push_back(name);
            }
            // Never released: the catalogue that holds it outlives the interpreter.
            const auto* call = new py::object(derivatives);
            const int d = static_cast<int>(coordinates.size());
            api::addSystemCalls(info, [id, call, names, d](const api::Parameters& values) {
                return makeCalls(id, d, *call, names, values);
            });
        },
        py::arg("id"), py::arg("title"), py::arg("description"), py::arg("coordinates"),
        py::arg("parameters"), py::arg("time_dependent"), py::arg("derivatives"),
        "Adds a system: derivatives(t, q, v, parameters) returns L, its gradient and Hessian in (q, v).");
}

}  // namespace extremal::python
