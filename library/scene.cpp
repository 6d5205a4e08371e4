// SPDX-License-Identifier: GPL-3.0-or-later
#include "extremal/scene.hpp"

#include "engine/run/load_scene.hpp"
#include "engine/scene/preset.hpp"
#include "engine/scene/read/json.hpp"
#include "library/data.hpp"

namespace extremal::api {
namespace {

Scene sceneOf(ReadScene read) {
    if (!read.errors.empty()) throw InvalidScene(std::move(read.errors));
    return Scene(std::make_shared<const Scene::Data>(Scene::Data{std::move(read)}));
}

/// `source`: JSON text, or a tree.
template <class Source>
Scene sceneFrom(const Source& source, const std::string& folder, const ReadOptions& options) {
    std::vector<Override> changes;
    for (const std::string& text : options.changes) changes.push_back(parseOverride(text));
    const std::string start = folder.empty() ? "." : folder;
    ReadScene read = readScene(source, changes, start);
    checkReferenceFile(read, start, changes, options.isTrusted);
    return sceneOf(std::move(read));
}

}  // namespace

const char* version() { return EXTREMAL_VERSION; }

Scene::Scene(std::shared_ptr<const Data> data) : data_(std::move(data)) {}

Scene Scene::load(const std::string& name, const ReadOptions& options) {
    if (options.folder.empty()) return sceneOf(loadScene(name, options.changes, options.isTrusted));
    return sceneFrom(loadSceneText(name), options.folder, options);
}
Scene Scene::parse(std::string_view json, const ReadOptions& options) {
    return sceneFrom(json, options.folder, options);
}
Scene Scene::from(const Value& document, const ReadOptions& options) {
    return sceneFrom(document, options.folder, options);
}

const std::vector<Problem>& Scene::warnings() const { return data_->read.warnings; }
const std::string& Scene::title() const { return data_->read.scene.title; }
std::string Scene::json() const { return writeScene(data_->read.scene); }
Value Scene::value() const { return toValue(data_->read.scene); }

std::vector<std::string> presets() {
    std::vector<std::string> ids;
    for (const Preset& preset : extremal::presets()) ids.emplace_back(preset.id);
    return ids;
}

Value parseJson(std::string_view text) { return extremal::parseJson(text); }
std::string writeJson(const Value& value) { return extremal::writeJson(value); }

}  // namespace extremal::api
