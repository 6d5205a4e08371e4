// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/mechanism/joined_constraints.hpp"

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

namespace extremal {
namespace {

struct JoinedModel {
    std::optional<Constraint> first;
    Constraint second;
    std::vector<int> rows;  ///< of the second
    int d = 0;

    int before() const { return first ? first->count() : 0; }
    std::vector<double> room(int columns) const {
        return std::vector<double>(static_cast<std::size_t>(second.count() * columns));
    }
};
const JoinedModel& joinedModel(const void* p) { return *static_cast<const JoinedModel*>(p); }

void firstOfJoined(const void* p, double t, const double* q, double* g, double* byPlace, double* byTime) {
    const JoinedModel& m = joinedModel(p);
    if (m.first) m.first->first(m.first->model.get(), t, q, g, byPlace, byTime);
    std::vector<double> value = m.room(1), place = m.room(m.d), time = m.room(1);
    m.second.first(m.second.model.get(), t, q, value.data(), place.data(), time.data());
    for (std::size_t i = 0; i < m.rows.size(); ++i) {
        const auto k = static_cast<std::size_t>(m.rows[i]);
        const int row = m.before() + static_cast<int>(i);
        g[row] = value[k];
        byTime[row] = time[k];
        std::copy_n(place.data() + m.rows[i] * m.d, m.d, byPlace + row * m.d);
    }
}

void addCurvatureOfJoined(const void* p, double t, const double* q, const double* lambda, double* matrix) {
    const JoinedModel& m = joinedModel(p);
    if (m.first) m.first->addCurvature(m.first->model.get(), t, q, lambda, matrix);
    std::vector<double> ofSecond = m.room(1);
    for (std::size_t i = 0; i < m.rows.size(); ++i)
        ofSecond[static_cast<std::size_t>(m.rows[i])] = lambda[static_cast<std::size_t>(m.before()) + i];
    m.second.addCurvature(m.second.model.get(), t, q, ofSecond.data(), matrix);
}

void ratesOfJoined(const void* p, double t, const double* q, const double* v, double* rates) {
    const JoinedModel& m = joinedModel(p);
    if (m.first) m.first->rates(m.first->model.get(), t, q, v, rates);
    std::vector<double> ofSecond = m.room(1);
    m.second.rates(m.second.model.get(), t, q, v, ofSecond.data());
    for (std::size_t i = 0; i < m.rows.size(); ++i)
        rates[static_cast<std::size_t>(m.before()) + i] = ofSecond[static_cast<std::size_t>(m.rows[i])];
}

}  // namespace

Constraint joinedConstraints(const Constraint* first, const Constraint& second, std::vector<int> rows,
                             int dimension) {
    Constraint made;
    if (first) made.names = first->names;
    for (const int k : rows) made.names.push_back(second.names[static_cast<std::size_t>(k)]);
    made.isTimeDependent = second.isTimeDependent || (first && first->isTimeDependent);
    made.model = std::make_shared<const JoinedModel>(JoinedModel{
        first ? std::optional<Constraint>(*first) : std::nullopt, second, std::move(rows), dimension});
    made.first = firstOfJoined;
    made.addCurvature = addCurvatureOfJoined;
    made.rates = ratesOfJoined;
    return made;
}

}  // namespace extremal
