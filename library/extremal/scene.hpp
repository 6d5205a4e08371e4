// SPDX-License-Identifier: GPL-3.0-or-later
/// Scenes: read, checked, with every default filled in. The format is documented in the handbook ("Scenes").
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/problem.hpp"
#include "engine/core/value.hpp"
#include "extremal/api.hpp"

namespace extremal::api {

struct ReadOptions {
    /// Changes before the scene is checked, from left to right: "/schemes/*/step=0.1", as --set.
    std::vector<std::string> changes = {};
    /// Where relative paths of the scene start. Empty: the folder of the file, else the current one.
    std::string folder = {};
    /// Files that the scene names outside its folder are read; otherwise they are an error, as the scene may
    /// come from a stranger.
    bool isTrusted = false;
};

class EXTREMAL_API Scene {
public:
    /// A path, or "preset:NAME". Throws InvalidScene.
    static Scene load(const std::string& name, const ReadOptions& options = {});
    /// JSON text. Throws InvalidScene.
    static Scene parse(std::string_view json, const ReadOptions& options = {});
    /// A tree. Throws InvalidScene.
    static Scene from(const Value& document, const ReadOptions& options = {});

    /// What is doubtful; never stops a run.
    const std::vector<Problem>& warnings() const;
    const std::string& title() const;
    /// With every default filled in; equal scenes give equal bytes.
    std::string json() const;
    Value value() const;

    struct Data;
    explicit Scene(std::shared_ptr<const Data> data);
    const Data& data() const { return *data_; }  ///< for the library itself

private:
    std::shared_ptr<const Data> data_;
};

/// The ids of the scenes that are supplied: Scene::load("preset:" + id).
EXTREMAL_API std::vector<std::string> presets();

/// JSON text as a tree, and back, indented. Throws InvalidScene, naming line and column.
EXTREMAL_API Value parseJson(std::string_view text);
EXTREMAL_API std::string writeJson(const Value& value);

}  // namespace extremal::api
