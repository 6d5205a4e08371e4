// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "engine/core/text/text.hpp"
#include "engine/model/phase_mechanics.hpp"
#include "engine/observe/catalog.hpp"
#include "engine/scene/bind.hpp"
#include "engine/scene/map_grid.hpp"
#include "engine/scene/read/pointer.hpp"
#include "engine/scene/read/read_parts.hpp"
#include "engine/scene/read/symmetries_of_scene.hpp"
#include "engine/scene/view_choices.hpp"
#include "engine/scene/write/format.hpp"
#include "engine/view/axes.hpp"
#include "engine/view/catalog.hpp"

namespace extremal {
namespace {

bool isOneOf(const std::vector<std::string>& names, std::string_view name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

/// What a view is read with, and its place in the document.
struct ViewReader {
    Reader& reader;
    const System* system;  ///< null: the model is wrong
    const Scene& scene;
    const Value& object;
    std::string pointer;

    void readColumns(View& view) const;
    void readScheme(View& view) const;
    void readNode(View& view) const;
    void readScale(View& view) const;
    void readRanges(View& view, const ViewAxes& axes) const;
    void readCurve(View& view, const ViewAxes& axes) const;
    bool applies(const View& view) const;
    void warnIfNotObserved(const View& view) const;

private:
    std::optional<ViewRange> rangeOf(const Value& value, const std::string& at, bool isLog) const;
};

void ViewReader::readColumns(View& view) const {
    const ViewKeys keys = keysOf(view.id, system);
    const char* const kind = keys.hasZeros ? "state column" : "column";
    const auto check = [&](const Value& given, const std::string& at, const std::string& name,
                           const std::vector<std::string>& names) {
        if (given.isString() && !isOneOf(names, name)) reader.unknownName(at, kind, name, names);
    };
    for (const auto& [key, target] : {std::pair{"x", &view.x}, std::pair{"y", &view.y}}) {
        const Value* column = object.find(key);
        if (!column) continue;
        const std::string at = childPointer(pointer, key);
        *target = reader.text(*column, at).value_or("");
        if (!keys.hasColumns)
            reader.error(at, "is only for phase portraits, trajectories and sections");
        else if (system)
            check(*column, at, *target, columnsFor(view.id, scene, *system));
    }
    const Value* column = object.find("at");
    if (!column) return;
    const std::string at = childPointer(pointer, "at");
    view.at = reader.text(*column, at).value_or("");
    if (!keys.hasZeros)
        reader.error(at, "is only for sections");
    else if (system)
        check(*column, at, view.at, zerosFor(*system));
}

void ViewReader::readScheme(View& view) const {
    const Value* label = object.find("scheme");
    if (!label) return;
    const std::string at = childPointer(pointer, "scheme");
    view.scheme = reader.text(*label, at).value_or("");
    const std::vector<std::string> labels = labelsOf(scene);
    if (!keysOf(view.id, system).hasScheme)
        reader.error(at, "is only for pictures of one scheme",
                     "the views sparsity, carpet and parameter-map, and profile in the plane");
    else if (label->isString() && reader.errors.empty() && !isOneOf(labels, view.scheme))
        reader.unknownName(at, "scheme", view.scheme, labels);
}

void ViewReader::readNode(View& view) const {
    const Value* node = object.find("node");
    if (!node) return;
    const std::string at = childPointer(pointer, "node");
    if (!keysOf(view.id, system).hasNode) return reader.error(at, "is only for the view shape-function");
    view.node = reader.number(
        *node, at,
        {1, static_cast<double>(lastNodeOf(scene)), false, true, "the nodes inside, from left to right"});
}

std::optional<ViewRange> ViewReader::rangeOf(const Value& value, const std::string& at, bool isLog) const {
    if (!reader.isArray(value, at, "two numbers")) return {};
    const Value::Array& ends = value.asArray();
    if (ends.size() != 2) {
        reader.error(
            at, "must have two numbers, the lower end and the upper one, got " + std::to_string(ends.size()));
        return {};
    }
    Limits limits;
    if (isLog) limits = Limits::positive();
    if (isLog) limits.hint = "this axis is logarithmic";
    const auto low = reader.number(ends[0], at + "/0", limits),
               high = reader.number(ends[1], at + "/1", limits);
    if (!low || !high) return {};
    const std::string got = ", got " + formatNumber(low->value) + " and " + formatNumber(high->value);
    if (!(low->value < high->value)) {
        reader.error(at, "must be two increasing numbers" + got);
    } else if (isLog ? !isDrawable(std::log10(low->value), std::log10(high->value), true)
                     : !isDrawable(low->value, high->value, false)) {
        reader.error(at, "cannot be drawn, the ends are too close together or too large" + got);
    } else {
        return ViewRange{*low, *high};
    }
    return {};
}

void ViewReader::readScale(View& view) const {
    const Value* log = object.find("log");
    if (!log) return;
    const std::string at = childPointer(pointer, "log");
    if (!findView(view.id)->scales.exist)
        return reader.error(at, "is for plots, and " + view.id + " has no axes with numbers", "leave it out");
    view.isLog = reader.flag(*log, at);
}

void ViewReader::readRanges(View& view, const ViewAxes& axes) const {
    const Value* range = object.find("range");
    const std::string at = childPointer(pointer, "range");
    if (!range || !reader.isObject(*range, at)) return;
    if (!axes.hasScales)
        return reader.error(at, "is for plots, and " + view.id + " has no axes with numbers", "leave it out");
    reader.checkKeys(*range, at, format::range);
    if (const Value* x = range->find("x")) view.xRange = rangeOf(*x, at + "/x", axes.isXLog);
    if (const Value* y = range->find("y")) view.yRange = rangeOf(*y, at + "/y", axes.isYLog);
}

void ViewReader::readCurve(View& view, const ViewAxes& axes) const {
    const Value* curve = object.find("curve");
    if (!curve) return;
    const std::string at = childPointer(pointer, "curve");
    const auto text = reader.text(*curve, at);
    if (!text) return;
    if (axes.variable.empty())
        return reader.error(at,
                            "is for plots against time or a place, and this one is against something else",
                            "a trajectory against t, say: \"x\": \"t\"");
    if (const auto read = reader.curve(*text, at, axes.variable)) view.curve = *read;
}

/// Whether the model and at least one scheme have the view.
bool ViewReader::applies(const View& view) const {
    const std::string missing = missingFor(view, *system);
    if (!missing.empty()) {
        const ObservableEntry* observable = findObservable(findView(view.id)->observable);
        if (observable && missing == observable->item.needs && missing == "a symmetry" &&
            mayHaveSymmetries(*system)) {
            reader.warning(
                pointer,
                view.id + " stays empty: " + scene.model.type + " with these parameters has no symmetry",
                "remove the view");
            return true;
        }
        reader.error(pointer, view.id + " is not defined for " + scene.model.type + "; remove the view",
                     "it needs " + missing + "; " + scene.model.type + " has " + joinNames(viewsOf(*system)));
        return false;
    }
    const ViewEntry& entry = *findView(view.id);
    std::string reasons;
    for (const SchemeSpec& scheme : scene.schemes) {
        const std::string reason = unsuitableFor(entry, resolve(scheme));
        if (reason.empty()) return true;
        reasons += (reasons.empty() ? "" : "; ") + scheme.label + " is " + reason;
    }
    if (scene.schemes.empty() || !reader.errors.empty()) return true;
    reader.error(pointer, view.id + " is not defined for any scheme of this scene; remove the view", reasons);
    return false;
}

void ViewReader::warnIfNotObserved(const View& view) const {
    const std::string& observable = findView(view.id)->observable;
    if (!observable.empty() && !isOneOf(scene.observe, observable) && missingFor(view, *system).empty())
        reader.warning(pointer, view.id + " stays empty: " + observable + " is not observed",
                       "add it to /observe");
}

const CatalogItem* itemOf(const Value* id) {
    for (const CatalogItem& item : viewCatalog())
        if (id && *id == Value(item.id)) return &item;
    return nullptr;
}

/// Keys that only this kind of view has. Those at their defaults are left out, so that a view without any is
/// its name alone.
void readOwnKeys(Reader& reader, const Value& object, const std::string& pointer, const CatalogItem& item,
                 View& view) {
    std::vector<FieldInfo> own = item.parameters;
    std::erase_if(own, [](const FieldInfo& field) {
        return isOneOf(format::view, field.key);
    });  // read by the others here
    if (!readFields(reader, object, pointer, own, format::view, view.keys)) view.keys = {};
    for (const FieldInfo& field : own)
        std::erase_if(view.keys.keys, [&](const Value::Member& m) {
            return m.first == field.key && m.second == field.fallback;
        });
}

}  // namespace

void readViews(Reader& reader, const Value& document, const System* system, Scene& scene) {
    const Value* views = document.find("views");
    if (!views) {
        for (const char* id : {"stage", "energy", "momentum", "error", "trajectory", "phase"}) {
            const std::string& observable = findView(id)->observable;
            const View view{id, "", ""};
            if ((observable.empty() || isOneOf(scene.observe, observable)) &&
                (!system || missingFor(view, *system).empty()))
                scene.views.push_back(view);
        }
        return;
    }
    if (!reader.isArray(*views, "/views", "names") ||
        !reader.hasAtMost(*views, "/views", "views", mostEntries))
        return;
    const auto known = idsOf(viewCatalog());
    for (std::size_t i = 0; i < views->asArray().size(); ++i) {
        const std::string pointer = childPointer("/views", i);
        const Value& value = views->asArray()[i];
        const Value object = value.isString() ? Value(Value::Object{{"view", value}}) : value;
        if (!reader.isObject(object, pointer)) continue;
        const CatalogItem* item = itemOf(object.find("view"));
        const bool isMap = item && item->id == mapView;
        if (!item) reader.checkKeys(object, pointer, format::view);
        const std::string place = value.isString() ? pointer : pointer + "/view";
        const Value* name = object.find("view");
        if (!name) {
            reader.error(place, "is required", "known: " + joinNames(known));
            continue;
        }
        View view;
        view.id = reader.text(*name, place).value_or("");
        const bool isKnown = isOneOf(known, view.id);
        if (name->isString() && !isKnown) reader.unknownName(place, "view", view.id, known);
        if (item && !isMap) readOwnKeys(reader, object, pointer, *item, view);
        const ViewReader parts{reader, system, scene, object, pointer};
        parts.readColumns(view);
        parts.readScheme(view);
        parts.readNode(view);
        view.size = readCardSize(reader, object, pointer);
        if (isKnown && system && parts.applies(view)) {
            parts.readScale(view);
            const ViewAxes axes = axesOf(view, *system);
            parts.readRanges(view, axes);
            parts.readCurve(view, axes);
            readStarts(reader, object, pointer, system, view);
            if (isMap) readMap(reader, object, pointer, format::view, *system, scene, view);
            parts.warnIfNotObserved(view);
        }
        scene.views.push_back(view);
    }
}

}  // namespace extremal
