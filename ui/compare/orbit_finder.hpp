// SPDX-License-Identifier: GPL-3.0-or-later
/// Periodic orbits near a start, sought beside the window's thread; what comes of it is said in a notice,
/// from which the orbit, or its manifolds in the section, go into the scene.
#pragma once

#include <QObject>

#include <stop_token>
#include <string>
#include <vector>

#include "engine/study/orbits/orbit_request.hpp"
#include "ui/workspace/document.hpp"

namespace extremal {

class Notices;
class Workspace;

class OrbitFinder : public QObject {
    Q_OBJECT
public:
    OrbitFinder(Workspace& workspace, Notices& notices, QObject* parent);
    ~OrbitFinder() override;

    /// Near the start of the scene with these edits, of the selected scheme, or of the first one that is on.
    void seek(const std::vector<Edit>& edits);
    bool isRunning() const { return isRunning_; }
    bool stop();  ///< false: nothing was sought

private:
    struct Search;
    void start(const Value& document, const OrbitRequest& request);
    void take(const Search& search);
    std::vector<Edit> editsFor(const OrbitAnswer& answer) const;
    void tell(const Search& search);
    void refuse(const QString& reason, const QString& remedy);

    Workspace& workspace_;
    Notices& notices_;
    bool isRunning_ = false;
    std::stop_source stop_{std::nostopstate};
};

}  // namespace extremal
