#include "ui/shell/background.hpp"

#include <QCoreApplication>
#include <QThreadPool>

#include <utility>

namespace extremal {

void runInBackground(std::function<void()> work) {
    const QString name = QStringLiteral("background");
    auto* pool = qApp->findChild<QThreadPool*>(name, Qt::FindDirectChildrenOnly);
    if (!pool) {
        pool = new QThreadPool(qApp);
        pool->setObjectName(name);
    }
    pool->start(std::move(work));
}

}  // namespace extremal
