// SPDX-License-Identifier: GPL-3.0-or-later
#include "extremal/study.hpp"

#include <condition_variable>
#include <exception>
#include <mutex>
#include <stop_token>
#include <thread>

#include "engine/figure/studies/study_figure.hpp"
#include "engine/study/request.hpp"
#include "engine/study/stability/stability_study.hpp"
#include "engine/study/sweep_log.hpp"
#include "library/data.hpp"

namespace extremal::api {
namespace {

StudyRequest requestOf(const std::string& kind, const StudyOptions& options) {
    StudyRequest request;
    request.kind = kind;
    request.metric = options.metric;
    request.isFinal = options.isFinal;
    request.steps = options.steps;
    request.from = options.from;
    request.to = options.to;
    request.points = options.points;
    request.error = options.error;
    request.x = options.x;
    request.y = options.y;
    request.findsLimits = options.findsLimits;
    request.repeat = options.repeat;
    request.only = options.only;
    request.wishes = options.wishes;
    request.candidates = options.candidates;
    request.searchTime = options.searchTime;
    request.budget = options.budget;
    return request;
}

}  // namespace

struct Study::Data {
    const StudyEntry& entry;
    AnyStudy work;
};

Study::Study(const std::string& kind, const Scene& scene, const StudyOptions& options) {
    const StudyRequest request = requestOf(kind, options);
    const StudyEntry& entry = knownStudy(request);
    if (entry.over == StudyEntry::Over::extremes && request.x.empty())
        throw InvalidScene("arguments", "extremes without x has scenes of its own",
                           "extremal study extremes runs it");
    data_.reset(
        new Data{entry, makeStudy(entry, request, scene.data().read.resolved.get(), options.threads)});
}
Study::~Study() = default;

bool Study::run(const Progress& progress) {
    return std::visit(
        [&](auto& work) {
            std::mutex mutex;
            std::condition_variable finished;
            bool isFinished = false;
            std::exception_ptr failure;
            std::jthread worker([&](const std::stop_token& stop) {
                try {
                    runLines(
                        work, [](const std::string&) {}, stop);
                } catch (...) {
                    failure = std::current_exception();
                }
                const std::lock_guard lock(mutex);
                isFinished = true;
                finished.notify_all();
            });
            const bool isWhole = watch(
                [&](auto time) {
                    std::unique_lock lock(mutex);
                    return finished.wait_for(lock, time, [&] { return isFinished; });
                },
                [&] { return work.fraction(); }, progress);
            if (!isWhole) worker.request_stop();
            worker.join();
            if (failure) std::rethrow_exception(failure);
            return isWhole;
        },
        data_->work);
}

bool Study::isComplete() const {
    return std::visit([](const auto& work) { return work.isComplete(); }, data_->work);
}

std::vector<Table> Study::tables() const {
    std::vector<Table> tables;
    std::visit(
        [&](const auto& work) {
            for (StudyTable& table : tablesOf(data_->entry, work))
                tables.push_back({std::move(table.name), std::move(table.columns), std::move(table.rows)});
        },
        data_->work);
    return tables;
}

std::vector<Figure> Study::figures() const {
    std::vector<Figure> result;
    std::visit(
        [&](const auto& work) {
            for (extremal::Figure& figure : studyFigures(data_->entry.item.id, work))
                if (!figure.view.empty()) result.push_back(handleOf(std::move(figure)));
        },
        data_->work);
    return result;
}

}  // namespace extremal::api
