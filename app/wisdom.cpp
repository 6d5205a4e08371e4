// SPDX-License-Identifier: GPL-3.0-or-later
#include <QSaveFile>

#include <charconv>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string_view>

#include "app/report.hpp"
#include "app/verbs.hpp"
#include "engine/core/text/text.hpp"
#include "engine/model/wave/basis/grid.hpp"
#include "engine/model/wave/basis/wisdom.hpp"
#include "engine/scene/read/json.hpp"

namespace extremal::app {
namespace {

std::optional<TransformSize> sizeOf(const std::string& text) {
    TransformSize size;
    const auto isMode = [](std::string_view part, int& n) {
        const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), n);
        return error == std::errc() && end == part.data() + part.size() && n >= 8 && n <= 65536 && n % 2 == 0;
    };
    const std::size_t cross = text.find('x');
    const std::string_view all = text;
    if (!isMode(all.substr(0, cross), size.nx) ||
        (cross != std::string::npos && !isMode(all.substr(cross + 1), size.ny)) ||
        static_cast<long long>(size.nx) * size.ny > wave::mostPlaces)
        return {};
    return size;
}

bool write(const std::string& file, const std::string& text) {
    QSaveFile out(QString::fromStdString(file));
    return out.open(QIODevice::WriteOnly) &&
           out.write(text.data(), static_cast<qint64>(text.size())) == static_cast<qint64>(text.size()) &&
           out.commit();
}

}  // namespace

int wisdomVerb(const WisdomOptions& options, const CommonOptions& common) {
    std::vector<TransformSize> sizes;
    for (const std::string& text : options.modes) {
        const auto size = sizeOf(text);
        if (!size) {
            printProblem(
                "--modes",
                "must be an even number from 8 to 65536, or two of them with at most 262144 nodes, got \"" +
                    text + "\"",
                "for example 256 or 256x256");
            return unusable;
        }
        sizes.push_back(*size);
    }
    if (std::filesystem::exists(options.out)) {
        try {
            useWisdom(options.out);
        } catch (const std::runtime_error& e) {
            printProblem("--out", e.what(), "another file, or remove it");
            return unusable;
        }
    }
    Table table{{{"modes", "estimated", "measured", "real, estimated", "real, measured"}},
                {false, true, true, true, true}};
    const auto microseconds = [](double value) { return formatNumber(value, 3) + " µs"; };
    Value::Array rows;
    for (std::size_t i = 0; i < sizes.size(); ++i) {
        const TransformGain gain = measureTransform(sizes[i]);
        table.rows.push_back({options.modes[i], microseconds(gain.estimated), microseconds(gain.measured),
                              microseconds(gain.realEstimated), microseconds(gain.realMeasured)});
        rows.emplace_back(Value::Object{{"modes", options.modes[i]},
                                        {"estimated", gain.estimated},
                                        {"measured", gain.measured},
                                        {"real_estimated", gain.realEstimated},
                                        {"real_measured", gain.realMeasured}});
    }
    if (!write(options.out, wisdom())) {
        printProblem(options.out, "could not be written", "choose an existing folder with write permission");
        return unwritable;
    }
    if (common.isJson)
        return print(writeJson(Value::Object{{"file", options.out}, {"transforms", rows}}), done);
    if (common.isQuiet) return done;
    return print(table.text() +
                     "\nMicroseconds per forward and backward transform, of wave functions and of fields "
                     "(real). Used if EXTREMAL_WISDOM=" +
                     options.out + " is in the environment.\n",
                 done);
}

}  // namespace extremal::app
