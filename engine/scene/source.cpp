// SPDX-License-Identifier: GPL-3.0-or-later
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "engine/core/text/regular_file.hpp"
#include "engine/core/text/text.hpp"
#include "engine/scene/preset.hpp"
#include "engine/scene/write/codec.hpp"

namespace extremal {
namespace {

constexpr std::size_t maxBytes = std::size_t{256} << 20;

std::string readAll(std::FILE* file) {
    std::string text;
    char block[1 << 16];
    for (std::size_t n = 0; (n = std::fread(block, 1, sizeof block, file)) > 0;) {
        text.append(block, n);
        if (text.size() > maxBytes)
            throw InvalidScene("", "is larger than 256 MB", "a scene has a few kilobytes");
    }
    if (std::ferror(file)) throw InvalidScene("", std::string("cannot be read: ") + std::strerror(errno));
    return text;
}

std::string readFile(const std::string& path) {
    std::error_code error;
    const auto status = std::filesystem::status(path, error);
    if (!std::filesystem::exists(status))
        throw InvalidScene("", "there is no such file", "a path, preset:NAME, or - for standard input");
    if (std::filesystem::is_directory(status))
        throw InvalidScene("", "is a folder", "name the scene file in it");
    if (!std::filesystem::is_regular_file(status))
        throw InvalidScene("", "is not a regular file", "- reads standard input");
    try {
        return readRegularFile(path, maxBytes);
    } catch (const UnreadableFile& e) {
        throw InvalidScene("", e.what(), "a scene has a few kilobytes");
    }
}

}  // namespace

const Preset* findPreset(std::string_view id) {
    for (const Preset& preset : presets())
        if (preset.id == id) return &preset;
    return nullptr;
}

std::string loadSceneText(const std::string& name) {
    constexpr std::string_view prefix = "preset:";
    if (name == "-") return readAll(stdin);
    if (!name.starts_with(prefix)) return readFile(name);
    const std::string id = name.substr(prefix.size());
    if (const Preset* preset = findPreset(id)) return std::string(preset->json);
    std::vector<std::string> ids;
    for (const Preset& preset : presets()) ids.emplace_back(preset.id);
    throw InvalidScene("", "there is no preset \"" + id + "\"", suggestName(id, ids));
}

}  // namespace extremal
