// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/workspace/own_schemes.hpp"

#include <QStandardPaths>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "engine/core/text/regular_file.hpp"
#include "engine/run/files/export.hpp"
#include "engine/scene/read/json.hpp"

namespace extremal {
namespace {

constexpr const char* mark = "extremal-schemes";

bool saysWhatItIs(const Value& scheme) {
    static constexpr const char* kinds[] = {"space", "baseline", "scheme"};
    return std::any_of(std::begin(kinds), std::end(kinds),
                       [&](const char* key) { return scheme.find(key) != nullptr; });
}

/// What is wrong with a name; empty if nothing is.
std::string faultOfName(const std::string& name) {
    if (name.find_first_not_of(' ') == std::string::npos) return "is empty";
    if (std::any_of(name.begin(), name.end(), [](unsigned char c) { return c < 0x20; }))
        return "must be one line of text";
    return {};
}

}  // namespace

OwnSchemes OwnSchemes::parse(std::string_view json) {
    const Value document = parseJson(json);
    OwnSchemes all;
    const Value* const schemes = document.find("schemes");
    if (document.isObject() && !document.find(mark) && saysWhatItIs(document)) {
        all.entries_ = {document};
    } else if (!document.find(mark) || !schemes || !schemes->isArray()) {
        throw InvalidScene("", "is not a catalogue of schemes",
                           std::string("{\"") + mark + "\": 1, \"schemes\": [..]}, or one scheme");
    } else {
        all.entries_ = schemes->asArray();
    }
    all.examine();
    return all;
}

OwnSchemes OwnSchemes::load(const std::string& file) {
    std::error_code ignored;
    if (!std::filesystem::exists(file, ignored)) return {};
    try {
        return parse(readRegularFile(file));
    } catch (const UnreadableFile& e) {
        throw InvalidScene(file, e.what(), "choose a file that can be read");
    } catch (const InvalidScene& e) {
        std::vector<Problem> problems = e.problems();
        for (Problem& p : problems) p.pointer = file + (p.pointer.empty() ? "" : ":" + p.pointer);
        throw InvalidScene(std::move(problems));
    }
}

std::string OwnSchemes::text() const { return writeJson(Value::Object{{mark, 1}, {"schemes", entries_}}); }

void OwnSchemes::save(const std::string& file) const {
    const std::filesystem::path path(file);
    if (path.has_parent_path()) prepareFolder(path.parent_path());
    writeFile(path, text(), {.isForced = true});  // it was read before
}

/// Which entries can be used, and what is wrong with the others.
void OwnSchemes::examine() {
    isSound_.assign(entries_.size(), true);
    faults_.clear();
    for (std::size_t i = 0; i < entries_.size(); ++i) {
        const std::string place = "/schemes/" + std::to_string(i);
        const auto fault = [&](const std::string& pointer, const std::string& message, const char* hint) {
            isSound_[i] = false;
            faults_.push_back({place + pointer, message, hint});
        };
        const Value* const label = entries_[i].find("label");
        if (!entries_[i].isObject() || !saysWhatItIs(entries_[i]))
            fault("", "names neither a space, a baseline nor a scheme", "an object as in a scene");
        else if (!label || !label->isString())
            fault("/label", "is required: the name of the scheme", "a text");
        else if (const std::string wrong = faultOfName(label->asString()); !wrong.empty())
            fault("/label", wrong, "a name on one line");
        else
            for (std::size_t j = 0; j < i; ++j)
                if (isSound_[j] && *entries_[j].find("label") == *label) {
                    fault("/label", "is the name of /schemes/" + std::to_string(j) + " already",
                          "names are different");
                    break;
                }
    }
}

std::vector<std::string> OwnSchemes::names() const {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < entries_.size(); ++i)
        if (isSound_[i]) names.push_back(entries_[i].find("label")->asString());
    return names;
}

std::size_t OwnSchemes::placeOf(std::string_view name) const {
    std::size_t i = 0;
    while (i < entries_.size() && !(isSound_[i] && entries_[i].find("label")->asString() == name)) ++i;
    return i;
}

const Value* OwnSchemes::find(std::string_view name) const {
    const std::size_t i = placeOf(name);
    return i < entries_.size() ? &entries_[i] : nullptr;
}

void OwnSchemes::add(const std::string& name, const Value& scheme) {
    if (const std::string wrong = faultOfName(name); !wrong.empty())
        throw InvalidScene("name", wrong, "a name on one line");
    if (find(name)) throw InvalidScene("name", "\"" + name + "\" is taken already", "another name");
    Value::Object kept{{"label", name}};
    for (const auto& [key, value] : scheme.asObject())
        if (key != "label" && key != "style" && key != "enabled") kept.emplace_back(key, value);
    entries_.emplace_back(std::move(kept));
    examine();
}

std::vector<std::string> OwnSchemes::import(const OwnSchemes& other) {
    std::vector<std::string> added;
    for (const std::string& name : other.names()) {
        std::string free = name;
        for (int k = 2; find(free); ++k) free = name + " (" + std::to_string(k) + ")";
        add(free, *other.find(name));
        added.push_back(free);
    }
    return added;
}

void OwnSchemes::rename(std::string_view name, const std::string& next) {
    if (name == next) return;
    if (const std::string wrong = faultOfName(next); !wrong.empty())
        throw InvalidScene("name", wrong, "a name on one line");
    if (find(next)) throw InvalidScene("name", "\"" + next + "\" is taken already", "another name");
    const std::size_t i = placeOf(name);
    if (i == entries_.size()) return;
    entries_[i].set("label", next);
    examine();
}

void OwnSchemes::remove(std::string_view name) {
    const std::size_t i = placeOf(name);
    if (i == entries_.size()) return;
    entries_.erase(entries_.begin() + static_cast<std::ptrdiff_t>(i));
    examine();
}

OwnSchemes OwnSchemes::only(std::string_view name) const {
    OwnSchemes one;
    if (const Value* scheme = find(name)) one.entries_ = {*scheme};
    one.examine();
    return one;
}

std::string ownSchemesFile() {
    if (const char* file = std::getenv("EXTREMAL_SCHEMES"); file && *file) return file;
    return (QStandardPaths::writableLocation(QStandardPaths::GenericConfigLocation) +
            "/extremal/schemes.json")
        .toStdString();
}

OwnSchemes ownSchemes() {
    try {
        return OwnSchemes::load(ownSchemesFile());
    } catch (const InvalidScene&) {
        return {};  // the window of the catalogue says why
    }
}

}  // namespace extremal
