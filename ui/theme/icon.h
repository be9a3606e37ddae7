#pragma once
#include <QColor>
#include <QIcon>
#include <QString>

namespace scantrove {

/// The icon resources/icons/<name>.svg, drawn in the palette's text colour of the moment (so it follows the
/// theme), or in `color` where one is given.
[[nodiscard]] QIcon icon(const QString& name, const QColor& color = {});

/// Makes the icons available; once, before the first use.
void initializeResources();

}  // namespace scantrove
