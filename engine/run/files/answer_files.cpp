// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/run/files/answer_files.hpp"

#include "engine/core/text/fingerprint.hpp"
#include "engine/run/files/export.hpp"
#include "engine/run/files/file_batch.hpp"
#include "engine/scene/read/json.hpp"

namespace extremal {

std::vector<std::string> writeAnswer(const AnswerFiles& answer, const std::filesystem::path& folder,
                                     const Replacing& replacing) {
    prepareFolder(folder);
    FileBatch batch(folder);
    Value::Array names;
    if (!answer.scene.empty()) {
        batch.write("scene.json", answer.scene);
        names.emplace_back("scene.json");
    }
    for (const auto& [name, text] : answer.tables) {
        batch.write(name, text);
        names.emplace_back(name);
    }
    names.emplace_back(answer.name + ".json");
    Value document{Value::Object{}};
    document.set("extremal", 1);
    for (const auto& [key, value] : answer.document.asObject()) document.set(key, value);
    if (!answer.scene.empty()) document.set("scene", fingerprint(answer.scene));
    document.set("files", std::move(names));
    batch.write(answer.name + ".json", writeJson(document));
    return batch.commit(replacing);
}

}  // namespace extremal
