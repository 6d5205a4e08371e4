// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/run/march/checkpoints.hpp"

#include <algorithm>
#include <iterator>
#include <sstream>
#include <utility>

#include "engine/core/algebra/instruction_set.hpp"
#include "engine/core/problem.hpp"
#include "engine/core/text/fingerprint.hpp"
#include "engine/core/text/regular_file.hpp"
#include "engine/run/files/export.hpp"
#include "engine/scene/read/json.hpp"

namespace extremal {
namespace {

constexpr double costs = 50;        ///< pauses are at least so many times what writing takes
constexpr double shortStage = 100;  ///< a stage that ended within the pause over this is not worth a file

/// The first line.
Value headOf(const Value& owner, const CheckpointPlan& plan) {
    Value head;
    head.set("extremal", 1);
    head.set("program", plan.program);
    head.set("machine", std::string(name(instructionSet())));
    head.set("scheme", *owner.find("scheme"));
    head.set("scene", fingerprint(owner.find("scene")->asString()));
    return head;
}

}  // namespace

SchemeCheckpoint::SchemeCheckpoint(std::filesystem::path file, const Value& owner, const CheckpointPlan& plan)
    : file_(std::move(file)),
      pause_(plan.seconds),
      due_(begin_ + std::chrono::duration_cast<Clock::duration>(pause_)) {
    const Value head = headOf(owner, plan);
    head_ = writeCompactJson(head);
    if (plan.isResumed)
        read(head);
    else
        remove();
}

void SchemeCheckpoint::read(const Value& head) {
    std::string text;
    try {
        text = readRegularFile(file_.string(), std::size_t{8} << 30);
    } catch (const UnreadableFile&) {  // nothing to go on from
        return;
    }
    std::istringstream in(std::move(text));
    std::string first, check;
    if (!std::getline(in, first) || !std::getline(in, check)) return;
    isWritten_ = true;
    if (first != head_) {
        std::string other = "scene";
        try {
            const Value found = parseJson(first);
            for (const char* const key : {"machine", "program"})
                if (const Value* const value = found.find(key); !value || !(*value == *head.find(key)))
                    other = key;
        } catch (const InvalidScene&) {
            other = "program";
        }
        throw InvalidScene("--resume", file_.string() + " belongs to another " + other,
                           "another --out DIR, or leave --resume out to begin anew");
    }
    std::string bytes{std::istreambuf_iterator<char>(in), {}};
    if (checksum(bytes) != check) return;
    Archive archive(std::move(bytes));
    std::size_t count = 0;
    archive(count);
    for (std::size_t i = 0; i < count; ++i) {
        std::string name;
        Stage stage;
        archive(name, stage);
        stages_[name] = std::move(stage);
    }
}

const SchemeCheckpoint::Stage* SchemeCheckpoint::find(const std::string& name) const {
    const auto found = stages_.find(name);
    return found == stages_.end() ? nullptr : &found->second;
}

void SchemeCheckpoint::write(const std::string& name, Stage stage) {
    const auto start = Clock::now();
    const bool isShort = stage.hasEnded && start - begin_ < pause_ / shortStage;
    stages_[name] = std::move(stage);
    if (isShort && !isWritten_) return;
    Archive archive;
    std::size_t count = stages_.size();
    archive(count);
    for (auto& [key, each] : stages_) {
        std::string own = key;
        archive(own, each);
    }
    try {
        std::filesystem::create_directories(file_.parent_path());
        writeFile(file_, head_ + '\n' + checksum(archive.bytes()) + '\n' + archive.bytes());
        isWritten_ = true;
        failure_.clear();
    } catch (const std::exception& e) {
        failure_ = e.what();
    }
    const auto now = Clock::now();
    due_ = now + std::chrono::duration_cast<Clock::duration>(
                     std::max(pause_, std::chrono::duration<double>(costs * (now - start))));
}

void SchemeCheckpoint::remove() {
    std::error_code ignored;
    std::filesystem::remove(file_, ignored);
    isWritten_ = false;
}

}  // namespace extremal
