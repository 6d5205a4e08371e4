// SPDX-License-Identifier: GPL-3.0-or-later
/// Messages to the user, shown as banners: problems are never modal dialogs.
#pragma once

#include <QObject>
#include <QString>
#include <functional>
#include <string>
#include <vector>

namespace extremal {

struct Notice {
    enum class Kind { information, warning, error };
    struct Choice {
        QString text;
        std::function<void()> act;  ///< the banner goes afterwards
    };
    Kind kind = Kind::information;
    QString key;   ///< a new notice replaces the old one of the same key
    QString text;  ///< what happened
    QString hint;  ///< what to try; may be empty
    std::vector<Choice> choices;
    std::string place = {};  ///< of the handbook, which explains it; may be empty
};

class Notices : public QObject {
    Q_OBJECT
public:
    using QObject::QObject;
    void post(Notice notice);
    void dismiss(const QString& key);
    const std::vector<Notice>& all() const { return all_; }
    /// Everything that was ever posted, with its time of day: the log.
    const QStringList& log() const { return log_; }
    void addToLog(const QString& line);

signals:
    void changed();
    void logChanged();
    void logRequested();  ///< the user wants to see it

private:
    std::vector<Notice> all_;
    QStringList log_;
};

}  // namespace extremal
