/// Undo and redo: the previous documents. Edits of the same place in quick succession (a dragged slider)
/// merge.
#pragma once

#include <QElapsedTimer>
#include <QString>
#include <vector>

#include "engine/core/value.hpp"

namespace extremal {

class History {
public:
    /// Forgets everything.
    void clear();
    /// Keeps `before`, the document as it was; `what` names the change ("Change stiffness").
    void push(Value before, const QString& what, const QString& mergeKey);

    bool canUndo() const { return !past_.empty(); }
    bool canRedo() const { return !future_.empty(); }
    QString undoText() const { return canUndo() ? past_.back().what : QString(); }
    QString redoText() const { return canRedo() ? future_.back().what : QString(); }
    /// The document to return to; `now` is stored for redo.
    Value undo(Value now);
    Value redo(Value now);

private:
    struct Entry {
        Value document;
        QString what, mergeKey;
    };
    std::vector<Entry> past_, future_;
    QElapsedTimer sincePush_;
};

}  // namespace extremal
