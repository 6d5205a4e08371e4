// SPDX-License-Identifier: GPL-3.0-or-later
/// The Python module extremal._extremal: the public headers of the library (library/extremal), with scenes
/// from dicts and results as numpy arrays that share memory with the library. What is friendlier to write in
/// Python is in extremal/__init__.py.
#include <pybind11/functional.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <exception>
#include <optional>

#include "extremal/extremal.hpp"
#include "python/active_calls.hpp"
#include "python/own_system.hpp"

namespace py = pybind11;

namespace extremal::python {
namespace {

py::object objectOf(const Value& value) {
    if (value.isBool()) return py::bool_(value.asBool());
    if (value.isNumber()) {
        const double number = value.asNumber();
        if (number == static_cast<double>(static_cast<long long>(number)) && number > -9e15 && number < 9e15)
            return py::int_(static_cast<long long>(number));
        return py::float_(number);
    }
    if (value.isString()) return py::str(value.asString());
    if (value.isArray()) {
        py::list list;
        for (const Value& entry : value.asArray()) list.append(objectOf(entry));
        return list;
    }
    if (value.isObject()) {
        py::dict dict;
        for (const auto& [key, member] : value.asObject()) dict[py::str(key)] = objectOf(member);
        return dict;
    }
    return py::none();
}

/// `pointer`: the place, for the message. Arrays of numpy are lists, its numbers are numbers.
Value valueOf(const py::handle& object, const std::string& pointer, int depth = 0) {
    if (depth > 200) throw InvalidScene(pointer, "is nested too deeply", "at most 200 levels");
    if (object.is_none()) return nullptr;
    if (py::isinstance<py::bool_>(object)) return object.cast<bool>();
    if (py::isinstance<py::str>(object)) return object.cast<std::string>();
    if (py::isinstance<py::dict>(object)) {
        Value value{Value::Object{}};
        for (const auto& [key, member] : object.cast<py::dict>()) {
            if (!py::isinstance<py::str>(key))
                throw InvalidScene(pointer,
                                   "has a key that is not text: " + py::repr(key).cast<std::string>());
            const auto name = key.cast<std::string>();
            value.set(name, valueOf(member, pointer + "/" + name, depth + 1));
        }
        return value;
    }
    if (py::hasattr(object, "tolist")) return valueOf(object.attr("tolist")(), pointer, depth + 1);
    if (py::isinstance<py::list>(object) || py::isinstance<py::tuple>(object)) {
        Value::Array array;
        for (const py::handle& entry : object)
            array.push_back(valueOf(entry, pointer + "/" + std::to_string(array.size()), depth + 1));
        return array;
    }
    if (py::hasattr(object, "__float__")) return object.attr("__float__")().cast<double>();
    throw InvalidScene(pointer, "cannot be in a scene: " + py::repr(object).cast<std::string>(),
                       "a dict, list, text, number, bool or None");
}

/// A read-only array on memory of the library, which lives as long as the owner.
template <class Owner>
py::array arrayOf(std::span<const double> values, const Owner& owner) {
    const py::capsule base(new Owner(owner), [](void* p) { delete static_cast<Owner*>(p); });
    py::array_t<double> array({static_cast<py::ssize_t>(values.size())}, {sizeof(double)}, values.data(),
                              base);
    array.attr("setflags")(py::arg("write") = false);
    return array;
}

/// Work of the library without the lock of Python, which is taken thirty times a second to look for Ctrl-C
/// and to call `progress(fraction)`; its False, or an exception, stops the work, as does one of a system that
/// is evaluated in Python.
template <class Work>
auto watched(const std::optional<py::function>& progress, const Work& work) {
    const ActiveCall active;
    std::exception_ptr failure;
    const auto look = [&](double fraction) {
        if (ActiveCalls::ofInterpreter().isEnding()) return false;
        const py::gil_scoped_acquire lock;
        try {
            if (PyErr_CheckSignals() != 0) throw py::error_already_set();
            rethrowOfSystem();
            if (!progress) return true;
            const py::object answer = (*progress)(fraction);
            return answer.is_none() || answer.cast<bool>();
        } catch (...) {
            failure = std::current_exception();
            return false;
        }
    };
    auto result = [&] {
        const py::gil_scoped_release unlocked;
        return work(look);
    }();
    if (failure) std::rethrow_exception(failure);
    rethrowOfSystem();
    return result;
}

/// Short work of the library, in which threads may evaluate systems in Python.
template <class Work>
auto unlocked(const Work& work) {
    const ActiveCall active;
    try {
        auto result = [&] {
            const py::gil_scoped_release lock;
            return work();
        }();
        rethrowOfSystem();
        return result;
    } catch (const InvalidScene&) {
        rethrowOfSystem();  // that is why
        throw;
    }
}

api::ReadOptions optionsOf(const std::vector<std::string>& changes, const std::string& folder, bool trust) {
    return {changes, folder, trust};
}

py::dict tableOf(const api::Table& table) {
    py::dict columns;
    for (std::size_t c = 0; c < table.columns.size(); ++c) {
        py::list values;
        for (const auto& row : table.rows) values.append(objectOf(row[c]));
        columns[py::str(table.columns[c])] = values;
    }
    return columns;
}

void bindScene(py::module_& m) {
    py::class_<api::Scene>(m, "Scene", "A scene: read, checked, every default filled in.")
        .def_static(
            "load",
            [](const std::string& name, const std::vector<std::string>& changes, const std::string& folder,
               bool trust) {
                return unlocked([&] { return api::Scene::load(name, optionsOf(changes, folder, trust)); });
            },
            py::arg("name"), py::arg("changes") = std::vector<std::string>(), py::arg("folder") = "",
            py::arg("trust") = false, "A file, or \"preset:NAME\".")
        .def_static(
            "from_dict",
            [](const py::dict& document, const std::vector<std::string>& changes, const std::string& folder,
               bool trust) {
                const Value value = valueOf(document, "");
                return unlocked([&] { return api::Scene::from(value, optionsOf(changes, folder, trust)); });
            },
            py::arg("document"), py::arg("changes") = std::vector<std::string>(), py::arg("folder") = "",
            py::arg("trust") = false, "A dict as in a scene file.")
        .def_property_readonly("title", &api::Scene::title)
        .def_property_readonly(
            "warnings",
            [](const api::Scene& scene) {
                std::vector<std::string> all;
                for (const Problem& p : scene.warnings()) all.push_back(p.pointer + ": " + p.message);
                return all;
            },
            "What is doubtful; never stops a run.")
        .def(
            "to_dict", [](const api::Scene& scene) { return objectOf(scene.value()); },
            "The scene with every default filled in.")
        .def("to_json", &api::Scene::json, "The same as the text of a scene file.")
        .def("__repr__",
             [](const api::Scene& scene) { return "<extremal.Scene \"" + scene.title() + "\">"; });
}

void bindResult(py::module_& m) {
    py::class_<api::SchemeResult>(
        m, "SchemeResult", "What one scheme gave: result[\"q.x\"] is a column as a read-only numpy array.")
        .def_property_readonly("label", &api::SchemeResult::label)
        .def_property_readonly("status", &api::SchemeResult::status, "\"done\", \"partial\" or \"failed\".")
        .def_property_readonly("cause", &api::SchemeResult::cause, "Why it failed; else empty.")
        .def_property_readonly(
            "summary", [](const api::SchemeResult& r) { return objectOf(r.summary()); },
            "Costs and errors: a row of summary.json.")
        .def("keys", &api::SchemeResult::columns, "The names of the columns.")
        .def("unit", &api::SchemeResult::unit, py::arg("column"))
        .def("__len__", &api::SchemeResult::rows)
        .def("__contains__",
             [](const api::SchemeResult& r, const std::string& name) {
                 const auto& all = r.columns();
                 return std::find(all.begin(), all.end(), name) != all.end();
             })
        .def("__getitem__",
             [](const api::SchemeResult& r, const std::string& name) {
                 try {
                     return arrayOf(r[name], r);
                 } catch (const std::out_of_range& e) {
                     throw py::key_error(e.what());
                 }
             })
        .def_property_readonly("components", &api::SchemeResult::components,
                               "Of fields and wave functions: what frames hold.")
        .def_property_readonly("frame_count", &api::SchemeResult::frames)
        .def(
            "frame",
            [](const api::SchemeResult& r, std::size_t index) {
                const api::Frame frame = r.frame(index);
                const auto components = static_cast<py::ssize_t>(r.components().size());
                return py::make_tuple(frame.t, arrayOf(frame.x, r),
                                      arrayOf(frame.values, r).reshape({components, py::ssize_t(-1)}));
            },
            py::arg("index"), "(t, x, values): values[c] is component c at the places x.")
        .def("__repr__", [](const api::SchemeResult& r) {
            return "<extremal.SchemeResult \"" + r.label() + "\": " + r.status() + ", " +
                   std::to_string(r.rows()) + " rows>";
        });
    py::class_<api::Comparison>(m, "Comparison", "The results of all schemes of a scene, in its order.")
        .def("__len__", &api::Comparison::size)
        .def("__getitem__",
             [](const api::Comparison& c, py::ssize_t index) {
                 const auto size = static_cast<py::ssize_t>(c.size());
                 if (index < -size || index >= size) throw py::index_error();
                 return c[static_cast<std::size_t>(index < 0 ? index + size : index)];
             })
        .def("__getitem__",
             [](const api::Comparison& c, const std::string& label) {
                 try {
                     return c[label];
                 } catch (const std::out_of_range& e) {
                     throw py::key_error(e.what());
                 }
             })
        .def_property_readonly("is_finished", &api::Comparison::isFinished, "False: it was stopped.")
        .def_property_readonly(
            "summary", [](const api::Comparison& c) { return objectOf(c.summary()); },
            "The document of summary.json.")
        .def(
            "write",
            [](const api::Comparison& c, const std::string& folder) {
                return unlocked([&] { return c.write(folder); });
            },
            py::arg("folder"), "Writes what `extremal run` does; returns the names of the files.")
        .def(
            "figures", [](const api::Comparison& c) { return unlocked([&] { return api::figures(c); }); },
            "Every plot that the scene asks for.")
        .def(
            "figure",
            [](const api::Comparison& c, const std::string& view) {
                return unlocked([&] { return api::figure(c, view); });
            },
            py::arg("view"), "The plot of one view.")
        .def("__repr__", [](const api::Comparison& c) {
            return "<extremal.Comparison of " + std::to_string(c.size()) + " schemes>";
        });
    m.def(
        "run",
        [](const api::Scene& scene, unsigned threads, const std::optional<py::function>& progress) {
            return watched(progress,
                           [&](const api::Progress& look) { return api::run(scene, threads, look); });
        },
        py::arg("scene"), py::arg("threads") = 0, py::arg("progress") = py::none());
    m.def(
        "run_many",
        [](const api::Scene& scene,
           const py::array_t<double, py::array::c_style | py::array::forcecast>& starts,
           const std::string& scheme, unsigned threads, const std::optional<py::function>& progress) {
            if (starts.ndim() != 2)
                throw InvalidScene("/starts", "must be an array of two dimensions, a state in each row");
            const std::span<const double> numbers(starts.data(), static_cast<std::size_t>(starts.size()));
            const api::Motions motions = watched(progress, [&](const api::Progress& look) {
                return api::runMany(scene, numbers, scheme, threads, look);
            });
            py::dict all;
            all["columns"] = motions.columns;
            const auto copyOf = [](const auto& values) {
                using Number = typename std::decay_t<decltype(values)>::value_type;
                return py::array_t<Number>(static_cast<py::ssize_t>(values.size()), values.data());
            };
            all["states"] = copyOf(motions.states).reshape({starts.shape(0), starts.shape(1)});
            all["causes"] = motions.causes;
            all["steps"] = copyOf(motions.steps);
            all["t"] = copyOf(motions.t);
            all["energy_error"] = copyOf(motions.energyError);
            all["together"] = motions.together;
            return all;
        },
        py::arg("scene"), py::arg("starts"), py::kw_only(), py::arg("scheme") = "", py::arg("threads") = 0,
        py::arg("progress") = py::none());
}

void bindFigure(py::module_& m) {
    py::class_<api::Figure>(m, "Figure", "A plot, as data and as SVG; a notebook shows it.")
        .def_property_readonly("view", &api::Figure::view)
        .def_property_readonly("title", &api::Figure::title)
        .def_property_readonly("x_title", &api::Figure::xTitle)
        .def_property_readonly("y_title", &api::Figure::yTitle)
        .def_property_readonly("summary", &api::Figure::summary)
        .def_property_readonly(
            "curves",
            [](const api::Figure& f) {
                py::list all;
                for (const api::Curve& c : f.curves())
                    all.append(py::make_tuple(c.label, arrayOf(c.x, f), arrayOf(c.y, f)));
                return all;
            },
            "[(label, x, y), ...]; NaN is a gap.")
        .def("svg", &api::Figure::svg, py::arg("width") = 640, py::arg("height") = 400,
             py::arg("dark") = false)
        .def("csv", &api::Figure::csv)
        .def("_repr_svg_", [](const api::Figure& f) { return f.svg(); })
        .def("__repr__", [](const api::Figure& f) { return "<extremal.Figure: " + f.summary() + ">"; });
}

void bindStudy(py::module_& m) {
    py::class_<api::Study>(m, "Study", "Many runs of a scene.")
        .def(py::init([](const std::string& kind, const api::Scene& scene, const std::string& metric,
                         bool final, const std::vector<double>& steps, double from, double to, int points,
                         double error, const std::string& x, const std::string& y, bool limit, int repeat,
                         const std::vector<std::string>& only, unsigned threads,
                         const std::vector<std::string>& wishes, const std::string& candidates,
                         const std::string& budget, const std::string& searchTime) {
                 return std::make_unique<api::Study>(
                     kind, scene,
                     api::StudyOptions{metric, final, steps, from, to, points, error, x, y, limit, repeat,
                                       only, threads, wishes, candidates, budget, searchTime});
             }),
             py::arg("kind"), py::arg("scene"), py::kw_only(), py::arg("metric") = "error",
             py::arg("final") = false, py::arg("steps") = std::vector<double>(), py::arg("from_step") = 0,
             py::arg("to_step") = 0, py::arg("points") = 0, py::arg("error") = 0, py::arg("x") = "",
             py::arg("y") = "", py::arg("limit") = false, py::arg("repeat") = 5,
             py::arg("only") = std::vector<std::string>(), py::arg("threads") = 0,
             py::arg("wishes") = std::vector<std::string>(), py::arg("candidates") = "",
             py::arg("budget") = "", py::arg("search_time") = "")
        .def(
            "run",
            [](api::Study& study, const std::optional<py::function>& progress) {
                return watched(progress, [&](const api::Progress& look) { return study.run(look); });
            },
            py::arg("progress") = py::none(), "Runs what is not known yet; False if it was stopped.")
        .def_property_readonly("is_complete", &api::Study::isComplete)
        .def_property_readonly(
            "tables",
            [](const api::Study& study) {
                py::dict all;
                for (const api::Table& table : study.tables()) all[py::str(table.name)] = tableOf(table);
                return all;
            },
            "The tables of the study by name, each a dict of columns.")
        .def("figures", &api::Study::figures);
}

void bindAnswers(py::module_& m) {
    m.def(
        "orbit",
        [](const api::Scene& scene, const std::string& scheme, const std::string& period,
           const std::optional<double>& energy, const std::string& hold, const std::string& follow,
           int points) {
            return objectOf(unlocked([&] {
                return api::orbit(scene, {scheme, period, energy, hold, follow, points});
            }));
        },
        py::arg("scene"), py::kw_only(), py::arg("scheme") = "", py::arg("period") = "",
        py::arg("energy") = py::none(), py::arg("hold") = "", py::arg("follow") = "", py::arg("points") = 0);
    m.def(
        "fit",
        [](const api::Scene& scene, const std::string& csv, const std::vector<std::string>& free,
           const std::string& scheme, const std::vector<std::string>& columns, bool bias) {
            return objectOf(unlocked([&] { return api::fit(scene, csv, {free, scheme, columns, bias}); }));
        },
        py::arg("scene"), py::arg("csv"), py::arg("free"), py::kw_only(), py::arg("scheme") = "",
        py::arg("columns") = std::vector<std::string>(), py::arg("bias") = true);
    m.def(
        "gradient",
        [](const api::Scene& scene, const std::vector<std::string>& with, const std::string& of,
           const std::string& over, const std::string& scheme) {
            return objectOf(unlocked([&] { return api::gradient(scene, {of, over, with, scheme}); }));
        },
        py::arg("scene"), py::arg("with_respect_to"), py::kw_only(), py::arg("of") = "", py::arg("over") = "",
        py::arg("scheme") = "");
    m.def(
        "steer",
        [](const api::Scene& scene, const std::string& over, const std::string& of,
           const std::vector<std::string>& end, const std::vector<std::string>& controls,
           const std::vector<std::string>& bounds, const std::string& scheme) {
            return objectOf(unlocked([&] {
                return api::steer(scene, {over, of, end, controls, bounds, scheme});
            }));
        },
        py::arg("scene"), py::kw_only(), py::arg("over") = "", py::arg("of") = "",
        py::arg("end") = std::vector<std::string>(), py::arg("controls") = std::vector<std::string>(),
        py::arg("bounds") = std::vector<std::string>(), py::arg("scheme") = "");
}

}  // namespace

PYBIND11_MODULE(_extremal, m) {
    static py::exception<InvalidScene> invalid(m, "InvalidScene", PyExc_ValueError);
    py::register_exception_translator([](std::exception_ptr p) {
        try {
            if (p) std::rethrow_exception(p);
        } catch (const InvalidScene& e) {
            py::list problems;
            for (const Problem& problem : e.problems())
                problems.append(py::make_tuple(problem.pointer, problem.message, problem.hint));
            const py::object error = py::reinterpret_borrow<py::object>(invalid)(e.what());
            error.attr("problems") = problems;
            PyErr_SetObject(invalid.ptr(), error.ptr());
        }
    });
    m.attr("__version__") = api::version();
    py::module_::import("atexit").attr("register")(py::cpp_function([] {
        const py::gil_scoped_release lock;
        ActiveCalls::ofInterpreter().end();
    }));
    bindScene(m);
    bindFigure(m);
    bindResult(m);
    bindStudy(m);
    bindAnswers(m);
    bindOwnSystem(m);
    m.def("presets", &api::presets, "The ids of the scenes that are supplied.");
    m.def("catalogue_names", &api::catalogueNames);
    m.def(
        "catalogue", [](const std::string& name) { return objectOf(api::catalogue(name)); }, py::arg("name"));
}

}  // namespace extremal::python
