#pragma once
#include <QColor>
#include <QIcon>
#include <QString>

namespace scantrove {

/// The icon resources/icons/<name>.svg in `color`, or if none is given in the palette's current text colour,
/// which follows the theme.
[[nodiscard]] QIcon icon(const QString& name, const QColor& color = {});

/// Makes the icons available. Call once before the first use.
void initializeResources();

}  // namespace scantrove
