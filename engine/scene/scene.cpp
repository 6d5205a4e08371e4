// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/scene/scene.hpp"

namespace extremal {

SchemeSpec::SchemeSpec() = default;
SchemeSpec::SchemeSpec(const SchemeSpec&) = default;
SchemeSpec::SchemeSpec(SchemeSpec&&) noexcept = default;
SchemeSpec& SchemeSpec::operator=(const SchemeSpec&) = default;
SchemeSpec& SchemeSpec::operator=(SchemeSpec&&) noexcept = default;
SchemeSpec::~SchemeSpec() = default;
bool SchemeSpec::operator==(const SchemeSpec&) const = default;

Scene::Scene() = default;
Scene::Scene(const Scene&) = default;
Scene::Scene(Scene&&) noexcept = default;
Scene& Scene::operator=(const Scene&) = default;
Scene& Scene::operator=(Scene&&) noexcept = default;
Scene::~Scene() = default;
bool Scene::operator==(const Scene&) const = default;

}  // namespace extremal
