#include "engine/study/point_log.hpp"

#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <optional>
#include <utility>

#include <boost/crc.hpp>

#include <fcntl.h>
#include <unistd.h>

#include "engine/core/problem.hpp"
#include "engine/core/text.hpp"
#include "engine/run/export.hpp"
#include "engine/scene/codec.hpp"
#include "engine/scene/json.hpp"

namespace extremal {
namespace {

std::string hex(unsigned long long value, int digits) {
    std::string text;
    for (int i = digits - 1; i >= 0; --i) text += "0123456789abcdef"[(value >> (4 * i)) & 15];
    return text;
}

std::string checksum(const std::string& text) {
    boost::crc_32_type crc;
    crc.process_bytes(text.data(), text.size());
    return hex(crc.checksum(), 8);
}

std::string cell(double value) { return std::isfinite(value) ? formatNumber(value) : ""; }
double number(const std::string& text) { return parseNumber(text).value_or(PointResult::unknown); }
long long count(const std::string& text) { return static_cast<long long>(parseNumber(text).value_or(0)); }

std::vector<std::string> cellsOf(const std::string& line) {
    std::vector<std::string> cells(1);
    for (const char c : line)
        if (c == ',')
            cells.emplace_back();
        else
            cells.back() += c;
    return cells;
}

/// The lines of a log whose checksums are right.
std::vector<std::string> linesOf(const std::filesystem::path& file) {
    std::ifstream in(file);
    std::vector<std::string> lines;
    for (std::string line; std::getline(in, line);) {
        const std::size_t space = line.rfind(' ');
        if (space == std::string::npos) continue;
        const std::string text = line.substr(0, space);
        if (line.substr(space + 1) == checksum(text)) lines.push_back(text);
    }
    return lines;
}

std::string headLine(const std::string& study, const Sweep& sweep) {
    Value head;
    head.set("extremal", 1);
    head.set("study", study);
    head.set("options", optionsValue(sweep.options()));
    head.set("scene", fingerprint(writeScene(sweep.scene().scene)));
    return writeCompactJson(head);
}

std::string pointLine(std::size_t index, const PointResult& r) {
    std::string line =
        "point," + std::to_string(index) + ',' + name(r.status) + ',' + std::string(name(r.cause));
    for (const double value : {r.failedAt, r.error}) line += ',' + cell(value);
    for (const long long value :
         {r.steps, r.cost.iterations, r.cost.evaluations, r.cost.linearSolves, r.cost.rejected})
        line += ',' + std::to_string(value);
    for (const double value : {r.cpuSeconds, r.cpuSpread, r.step, r.tolerance}) line += ',' + cell(value);
    return line;
}

std::optional<PointResult> pointOf(const std::vector<std::string>& cells) {
    if (cells.size() != 15) return {};
    PointResult r;
    r.status = cells[2] == name(RunStatus::done) ? RunStatus::done : RunStatus::failed;
    for (int k = 0; k <= static_cast<int>(Outcome::stopped); ++k)
        if (name(static_cast<Outcome>(k)) == cells[3]) r.cause = static_cast<Outcome>(k);
    r.failedAt = number(cells[4]);
    r.error = number(cells[5]);
    r.steps = count(cells[6]);
    r.cost = {count(cells[7]), count(cells[8]), count(cells[9]), count(cells[10])};
    r.cpuSeconds = number(cells[11]);
    r.cpuSpread = number(cells[12]);
    r.step = number(cells[13]);
    r.tolerance = number(cells[14]);
    return r;
}

bool isSameButForTimes(PointResult a, PointResult b) {
    for (PointResult* r : {&a, &b}) r->cpuSeconds = r->cpuSpread = PointResult::unknown;
    return pointLine(0, a) == pointLine(0, b);
}

}  // namespace

Value optionsValue(const SweepOptions& options) {
    const auto texts = [](const auto& items) {
        Value::Array all;
        for (const auto& item : items) all.emplace_back(item);
        return Value(all);
    };
    Value value;
    value.set("metric", options.metric);
    value.set("final", options.isAtEnd);
    value.set("steps", texts(options.ladder.steps));
    value.set("from", options.ladder.from);
    value.set("to", options.ladder.to);
    value.set("points", options.ladder.points);
    value.set("repeat", options.repeat);
    value.set("only", texts(options.only));
    value.set("error", options.wantedError);
    return value;
}

SweepOptions optionsOf(const Value& value) {
    SweepOptions options;
    options.metric = value.find("metric")->asString();
    options.isAtEnd = value.find("final")->asBool();
    for (const Value& step : value.find("steps")->asArray()) options.ladder.steps.push_back(step.asNumber());
    options.ladder.from = value.find("from")->asNumber();
    options.ladder.to = value.find("to")->asNumber();
    options.ladder.points = static_cast<int>(value.find("points")->asNumber());
    options.repeat = static_cast<int>(value.find("repeat")->asNumber());
    for (const Value& label : value.find("only")->asArray()) options.only.push_back(label.asString());
    options.wantedError = value.find("error")->asNumber();
    return options;
}

std::string fingerprint(const std::string& text) {
    boost::crc_optimal<64, 0x42f0e1eba9ea3693ULL, ~0ULL, ~0ULL, true, true> crc;
    crc.process_bytes(text.data(), text.size());
    return hex(crc.checksum(), 16);
}

PointLog::PointLog(std::filesystem::path file, bool isNew) : file_(std::move(file)) {
    const int flags = O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC | (isNew ? O_TRUNC : 0);
    descriptor_ = ::open(file_.c_str(), flags, 0666);
    if (descriptor_ < 0) throw ExportError(file_, std::strerror(errno));
}

PointLog::PointLog(PointLog&& other) noexcept
    : file_(std::move(other.file_)), descriptor_(std::exchange(other.descriptor_, -1)) {}

PointLog::~PointLog() {
    if (descriptor_ >= 0) ::close(descriptor_);
}

PointLog PointLog::begin(const std::filesystem::path& file, const std::string& study, const Sweep& sweep) {
    PointLog log(file, true);
    log.append(headLine(study, sweep));
    return log;
}

PointLog PointLog::resume(const std::filesystem::path& file, const std::string& study, Sweep& sweep) {
    const std::vector<std::string> lines = linesOf(file);
    if (lines.empty()) return begin(file, study, sweep);
    if (lines.front() != headLine(study, sweep))
        throw InvalidScene("--resume", file.string() + " belongs to another study, scene or option",
                           "another --out DIR, or leave --resume out to begin anew");
    takePoints(file, sweep);
    PointLog log(file, false);
    // A line that was cut off must not swallow the next one.
    std::ifstream in(file, std::ios::binary | std::ios::ate);
    if (in.tellg() > 0) {
        in.seekg(-1, std::ios::end);
        if (in.get() != '\n' && ::write(log.descriptor_, "\n", 1) != 1)
            throw ExportError(file, std::strerror(errno));
    }
    return log;
}

void PointLog::append(const std::string& text) {
    const std::string line = text + ' ' + checksum(text) + '\n';
    for (std::size_t done = 0; done < line.size();) {
        const ssize_t n = ::write(descriptor_, line.data() + done, line.size() - done);
        if (n < 0 && errno == EINTR) continue;
        if (n < 0) throw ExportError(file_, std::strerror(errno));
        done += static_cast<std::size_t>(n);
    }
}

void PointLog::add(std::size_t index, const PointResult& result) { append(pointLine(index, result)); }

void PointLog::add(const ReferenceInfo& reference) {
    append("reference," + reference.type + ',' + cell(reference.estimatedError));
}

LogHead readLogHead(const std::filesystem::path& file) {
    const std::vector<std::string> lines = linesOf(file);
    const std::string what = file.string() + " is not the log of a study";
    if (lines.empty()) throw InvalidScene("arguments", what, "a folder that extremal study has written");
    const Value head = parseJson(lines.front());
    if (!head.find("study") || !head.find("options") || !head.find("scene"))
        throw InvalidScene("arguments", what, "a folder that extremal study has written");
    return {head.find("study")->asString(), head.find("scene")->asString(), optionsOf(*head.find("options"))};
}

std::vector<std::size_t> takePoints(const std::filesystem::path& file, Sweep& sweep) {
    std::vector<std::size_t> taken;
    for (const std::string& line : linesOf(file)) {
        const std::vector<std::string> cells = cellsOf(line);
        if (cells.front() == "reference" && cells.size() == 3) {
            ReferenceInfo info;
            info.type = cells[1];
            info.estimatedError = number(cells[2]);
            sweep.take(info);
        }
        if (cells.front() != "point") continue;
        const std::optional<PointResult> result = pointOf(cells);
        const auto index = static_cast<std::size_t>(count(cells.size() > 1 ? cells[1] : ""));
        if (!result || index >= sweep.size()) continue;
        const PointResult& known = sweep.rows()[index].result;
        if (known.status != RunStatus::waiting && !isSameButForTimes(known, *result))
            throw InvalidScene("arguments",
                               file.string() + " has another result for point " + std::to_string(index),
                               "logs of the same version on the same kind of machine");
        sweep.take(index, *result);
        taken.push_back(index);
    }
    return taken;
}

}  // namespace extremal
