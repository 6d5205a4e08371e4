// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/run/files/replacing.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>

#include "engine/core/problem.hpp"
#include "engine/core/text/fingerprint.hpp"
#include "engine/run/files/export.hpp"
#include "engine/scene/read/json.hpp"

namespace extremal {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view mark = "made by Extremal, fingerprint ";

std::string contentOf(const fs::path& file, std::size_t most = std::string::npos) {
    std::ifstream in(file, std::ios::binary);
    if (most == std::string::npos) return {std::istreambuf_iterator<char>(in), {}};
    std::string text(most, '\0');
    in.read(text.data(), static_cast<std::streamsize>(most));
    text.resize(static_cast<std::size_t>(in.gcount()));
    return text;
}

std::string_view firstLineOf(std::string_view text) { return text.substr(0, text.find('\n')); }

/// Whether the files have the same bytes.
bool isSame(const fs::path& a, const fs::path& b) {
    std::error_code error;
    if (fs::file_size(a, error) != fs::file_size(b, error) || error) return false;
    std::ifstream x(a, std::ios::binary), y(b, std::ios::binary);
    return x && y && std::equal(std::istreambuf_iterator<char>(x), {}, std::istreambuf_iterator<char>(y), {});
}

/// The object in a text; null where the text has another form.
Value objectOf(const std::string& text) {
    try {
        Value value = parseJson(text);
        return value.isObject() ? value : Value();
    } catch (const InvalidScene&) {
        return {};
    }
}

bool hasText(const Value& object, const char* key, std::string_view text) {
    const Value* const value = object.isObject() ? object.find(key) : nullptr;
    return value && value->isString() && value->asString() == text;
}

fs::path folderOfFile(const fs::path& file) {
    return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

/// The documents that list the files beside them: of a run, and of answers (answer_files.hpp).
constexpr const char* documents[] = {"summary.json",  "orbit.json", "fit.json",
                                     "gradient.json", "steer.json", "motions.json"};

/// One of them in the folder; null where it is missing, or is not the program's.
Value documentIn(const fs::path& folder, const std::string& name) {
    const Value document = objectOf(contentOf(folder / name));
    const bool isOwn = document.isObject() && document.find("extremal") && document.find("files") &&
                       (name != documents[0] || document.find("schemes"));
    return isOwn ? document : Value();
}
Value summaryIn(const fs::path& folder) { return documentIn(folder, documents[0]); }

/// The first line of a log of a study, or of a checkpoint, without its checksum.
Value keysOf(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    std::string line;
    if (!std::getline(in, line)) return {};
    const std::size_t end = line.rfind('}');
    const Value head = end == std::string::npos ? Value() : objectOf(line.substr(0, end + 1));
    return head.isObject() && head.find("extremal") && head.find("scene") ? head : Value();
}

bool isListed(const fs::path& file) {
    return std::any_of(std::begin(documents), std::end(documents), [&](const char* document) {
        const Value found = documentIn(folderOfFile(file), document);
        const Value* const files = found.isObject() ? found.find("files") : nullptr;
        if (!files || !files->isArray()) return false;
        const auto& all = files->asArray();
        return std::any_of(all.begin(), all.end(), [&](const Value& name) {
            return name.isString() && name.asString() == file.filename().string();
        });
    });
}

bool isOwnScene(const fs::path& file) {
    const std::string print = fingerprint(contentOf(file));
    const fs::path folder = folderOfFile(file);
    const Value summary = summaryIn(folder);
    // Earlier versions have written no fingerprint.
    if (summary.isObject() && !summary.find("scene") ? isListed(file) : hasText(summary, "scene", print))
        return true;
    for (const char* document : documents)
        if (hasText(documentIn(folder, document), "scene", print)) return true;
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(folder, ignored))
        if (entry.path().extension() == ".log" && hasText(keysOf(entry.path()), "scene", print)) return true;
    return false;
}

/// Whether the text has a mark, and nothing has been changed in it since.
bool isMarked(const std::string& text) {
    const std::size_t at = text.find(mark);
    if (at == std::string::npos) return false;
    const std::size_t before = text.rfind('\n', at), after = text.find('\n', at);
    const std::size_t begin = before == std::string::npos ? 0 : before + 1;
    const std::string rest =
        text.substr(0, begin) + (after == std::string::npos ? "" : text.substr(after + 1));
    return text.substr(at + mark.size(), 16) == fingerprint(rest);
}

bool isOwnPicture(const std::string& bytes) {
    if (bytes.starts_with("\x89PNG")) return bytes.find(std::string("Software\0Extremal", 17)) < 4096;
    // Of QPdfWriter, which writes texts in UTF-16.
    static constexpr std::string_view creator("/Creator (\xfe\xff\0E\0x\0t\0r\0e\0m\0a\0l", 28);
    return bytes.starts_with("%PDF") && bytes.find(creator) != std::string::npos;
}

/// These, or these and further ones.
bool hasColumns(std::string_view line, std::string_view columns) {
    return line.starts_with(columns) && (line.size() == columns.size() || line[columns.size()] == ',');
}

bool isOwn(const fs::path& file, std::optional<std::string_view> text) {
    const std::string name = file.filename().string(), kind = file.extension().string();
    if (name == "scene.json") return isOwnScene(file);
    if (std::find(std::begin(documents), std::end(documents), name) != std::end(documents))
        return documentIn(folderOfFile(file), name).isObject();
    if (kind == ".log" || kind == ".checkpoint") return keysOf(file).isObject();
    if (kind == ".csv") {
        const std::string first(firstLineOf(contentOf(file, 1 << 16)));
        // Before a run its columns are not known, but how they begin.
        return text ? hasColumns(first, firstLineOf(*text)) || isListed(file)
                    : isListed(file) || first.starts_with("t,") || first.starts_with("x,") ||
                          first.starts_with("label,") || first.starts_with("panel,scheme,");
    }
    const std::string bytes = contentOf(file);
    return isOwnPicture(bytes) || isMarked(bytes) || isListed(file);
}

void refuseRead(const fs::path& file, const Replacing& replacing) {
    std::error_code ignored;
    for (const fs::path& each : replacing.read)
        if (fs::equivalent(file, each, ignored))
            throw InvalidScene("--out", "would replace " + file.string() + ", which is read",
                               "another place for the results");
}

void requireOwn(const fs::path& file, const Replacing& replacing, std::optional<std::string_view> text) {
    if (replacing.isForced || isOwn(file, text)) return;
    throw ForeignFile(file);
}

}  // namespace

void requireReplaceable(const fs::path& file, const Replacing& replacing,
                        std::optional<std::string_view> text) {
    std::error_code error;
    if (!fs::is_regular_file(file, error)) return;  // the writer says what stands in its way
    if (text && contentOf(file, text->size() + 1) == *text) return;
    refuseRead(file, replacing);
    requireOwn(file, replacing, text);
}

bool mayReplace(const fs::path& file, const fs::path& content, const Replacing& replacing) {
    std::error_code error;
    if (!fs::is_regular_file(file, error)) return true;
    if (isSame(file, content)) return false;
    refuseRead(file, replacing);
    requireOwn(file, replacing, contentOf(content, 1 << 16));
    return true;
}

std::string markedAsOwn(const std::string& text, const std::string& begin, const std::string& end, int line) {
    std::size_t at = 0;
    for (int i = 0; i < line && at != std::string::npos; ++i) {
        at = text.find('\n', at);
        if (at != std::string::npos) ++at;
    }
    std::string marked = text;
    return marked.insert(std::min(at, text.size()),
                         begin + std::string(mark) + fingerprint(text) + end + '\n');
}

}  // namespace extremal
