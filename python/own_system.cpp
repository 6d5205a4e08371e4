#include "python/own_system.hpp"

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <exception>
#include <limits>
#include <map>
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
    py::object derivatives;
    py::dict parameters;

    PythonLagrangian(int d, py::object call, py::dict values)
        : LagrangianCalls{d, &callJet, &callGradient},
          derivatives(std::move(call)),
          parameters(std::move(values)) {}

    static void callJet(const LagrangianCalls* self, double t, const double* q, const double* v,
                        double* value, double* gradient, double* hessian) {
        const auto& own = *static_cast<const PythonLagrangian*>(self);
        const auto n = static_cast<std::size_t>(2 * own.dimension);
        const py::gil_scoped_acquire lock;
        try {
            const auto list = [&](const double* x) { return std::vector<double>(x, x + own.dimension); };
            const py::tuple all = own.derivatives(t, list(q), list(v), own.parameters);
            using Array = py::array_t<double, py::array::c_style | py::array::forcecast>;
            const Array g = all[1].cast<Array>(), h = all[2].cast<Array>();
            *value = all[0].cast<double>();
            std::copy_n(g.data(), n, gradient);
            if (hessian) std::copy_n(h.data(), n * n, hessian);
        } catch (...) {
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
std::shared_ptr<const api::LagrangianCalls> makeCalls(int d, const py::object& call,
                                                      const std::vector<std::string>& names,
                                                      const api::Parameters& parameters) {
    const py::gil_scoped_acquire lock;
    py::dict values;
    for (const std::string& name : names) values[py::str(name)] = parameters[name];
    return {new PythonLagrangian(d, call, values), [](const api::LagrangianCalls* calls) {
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
            api::addSystemCalls(info, [call, names, d](const api::Parameters& values) {
                return makeCalls(d, *call, names, values);
            });
        },
        py::arg("id"), py::arg("title"), py::arg("description"), py::arg("coordinates"),
        py::arg("parameters"), py::arg("time_dependent"), py::arg("derivatives"),
        "Adds a system: derivatives(t, q, v, parameters) returns L, its gradient and Hessian in (q, v).");
}

}  // namespace extremal::python
