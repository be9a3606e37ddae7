#include "ui/panels/help_dialog.h"

#include <QDialogButtonBox>
#include <QGridLayout>
#include <QLabel>
#include <QScreen>
#include <QScrollArea>
#include <QScrollBar>
#include <QVBoxLayout>
#include <algorithm>

namespace scantrove {
namespace {

constexpr double kMaxOfScreen = 0.9;  ///< share of the screen's height
constexpr int kNarrowest_px = 720;    ///< so that the dialog fits on half a screen of 1600 pixels

}  // namespace

HelpDialog::HelpDialog(QWidget* parent) : QDialog(parent) {
  setWindowTitle(tr("Keys and mouse"));
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(22, 18, 22, 16);
  layout->setSpacing(14);
  auto* keys_and_meanings = new QWidget;
  auto* grid = new QGridLayout(keys_and_meanings);
  grid->setContentsMargins(0, 0, 10, 0);
  grid->setHorizontalSpacing(22);
  grid->setVerticalSpacing(6);

  int row = 0;
  const auto heading = [&](const QString& text) {
    auto* label = new QLabel(QStringLiteral("<b>%1</b>").arg(text));
    if (row > 0) label->setContentsMargins(0, 10, 0, 0);
    grid->addWidget(label, row++, 0, 1, 2);
  };
  const auto line = [&](const QString& keys, const QString& meaning) {
    auto* label = new QLabel(keys);
    label->setProperty("keys", true);
    grid->addWidget(label, row, 0);
    grid->addWidget(new QLabel(meaning), row++, 1);
  };
  heading(tr("Scan"));
  line(tr("Ctrl+O, Ctrl+Shift+O, Ctrl+Alt+O"), tr("Open a folder, a recording, or either with options"));
  line(tr("Ctrl+K"), tr("Scan with a camera"));
  line(tr("Ctrl+J, Ctrl+N"), tr("Open a project; make a new one"));
  line(tr("Space"), tr("Pause, resume"));
  line(tr("N"), tr("Step one frame"));
  line(tr("Ctrl+R"), tr("Scan from the beginning"));
  line(tr("Ctrl+."), tr("Stop"));
  line(tr("Ctrl+Shift+S, Ctrl+Shift+R"), tr("Skip the refinement; refine later"));
  line(tr("Ctrl+Alt+R"), tr("Continue the saved scan with more frames"));
  line(tr("Ctrl+W"), tr("Close scan"));
  heading(tr("Objects (with the list in focus)"));
  line(tr("Ctrl+L"), tr("Go to the object list"));
  line(tr("Ctrl+F"), tr("Find an object by name or class"));
  line(tr("Ctrl+Return, double click a picture"), tr("Page of the object: views, 3D model, scans"));
  line(tr("F2"), tr("Rename"));
  line(tr("Return"), tr("Confirm, unconfirm"));
  line(tr("Del"), tr("Delete"));
  line(tr("M"), tr("Merge the selected objects into one"));
  line(tr("Ctrl+Z, Ctrl+Shift+Z"), tr("Undo, redo"));
  line(tr("Ctrl+Shift+L"), tr("Classes"));
  heading(tr("Regions (in the 3D view and in the images)"));
  line(tr("Click, Ctrl+click"), tr("Select a region; select another one as well"));
  line(tr("Ctrl+drag (images: drag)"), tr("Select all regions in a rectangle"));
  line(tr("Tab, Shift+Tab"), tr("Next and previous region by size"));
  line(tr("Return, double click"), tr("Name the region"));
  line(tr("1 … 9"), tr("Give it a recent name"));
  line(tr("Return, Shift+Return, Tab while naming"),
       tr("If another object has the name: another one; the same one; choose"));
  line(tr("J"), tr("Join"));
  line(tr("C, then two strokes or clicks"), tr("Split: draw over one part, then over the other"));
  line(tr("C, then one stroke or click, Return"), tr("Split off what has other colours around it"));
  line(tr("Shift, Return, Escape while splitting"), tr("Add a stroke; accept; cancel"));
  line(tr("+ and −"), tr("Split further, merge with neighbour (without a selection: zoom)"));
  line(tr("B, O, Del"), tr("Background; mark as object; not an object"));
  line(tr("Ctrl+B"), tr("Mark all supports as background"));
  line(tr("A, Shift+A, Backspace"), tr("Suggestion: accept; accept all; reject"));
  line(tr("."), tr("Zoom to selection"));
  line(tr("Escape"), tr("Deselect"));
  line(tr("Page up, Page down"), tr("Previous, next key frame (after the scan)"));
  line(tr("K, Shift+K, Ctrl+Shift+K"), tr("Key frame: checked; left out of data sets; open again"));
  line(tr("Ctrl+Page down, Ctrl+Page up"), tr("Next, previous open key frame"));
  line(tr("Ctrl+E"), tr("Export data set"));
  line(tr("Ctrl+Shift+P"), tr("Save picture of the scan"));
  heading(tr("Image mode"));
  line(tr("Ctrl+I, double click the title of an image"), tr("Image mode on and off; show that image"));
  line(tr("Wheel, Ctrl++, Ctrl+−, Ctrl+0"), tr("Zoom; fit"));
  line(tr("Middle drag, Space+drag"), tr("Move the image"));
  line(tr("V, D"), tr("Next image; 3D view beside it"));
  line(tr("M, Shift+M"), tr("Masks filled, outlined, off; names"));
  line(tr("S, P, E, L, W, H"), tr("Select, brush, eraser, polygon, magic edge, fill hole (in a key frame)"));
  line(tr("[ and ], Ctrl+wheel"), tr("Size of the brush"));
  line(tr("Return, Backspace, Escape"), tr("Polygon: close, one corner back; drop what is drawn"));
  line(tr("Ins"), tr("Paint a new region"));
  heading(tr("3D view"));
  line(tr("Drag, arrow keys"), tr("Turn"));
  line(tr("Shift+drag, Shift+arrow keys"), tr("Move"));
  line(tr("Wheel, + and −"), tr("Zoom"));
  line(tr("Double click on the background, Home, Ctrl+0"), tr("Show all"));
  line(tr("F"), tr("Follow the camera"));
  line(tr("G, Shift+G"), tr("Ground grid; show where to move"));
  line(tr("Alt+1 … Alt+5, R"), tr("Colour by scene, regions, both, direction, height; next mode"));
  line(tr("Shift+N"), tr("Names of the regions"));
  line(tr("Shift+B"), tr("Background shown, dimmed, hidden"));
  line(tr("X, Ctrl+wheel"), tr("Clip plane, move the plane"));
  line(tr("T"), tr("Measure between two clicks"));
  line(tr("Ctrl+Alt+1 … Ctrl+Alt+6"), tr("View from front, back, left, right, top, bottom"));
  heading(tr("Window"));
  line(tr("Ctrl+1 … Ctrl+4"), tr("Show or hide objects, current frame, settings, history"));
  line(tr("Click the title of an image, V"), tr("Enlarge it (twice: image mode)"));
  line(tr("F11"), tr("Presentation mode"));
  line(tr("?, F1"), tr("Show these keys"));
  line(tr("Ctrl+F1"), tr("Show the guide in the browser"));
  line(tr("Ctrl+Q"), tr("Quit"));
  auto* scroll = new QScrollArea;  // for low screens
  scroll->setFrameShape(QFrame::NoFrame);
  scroll->setWidgetResizable(true);
  scroll->setWidget(keys_and_meanings);
  layout->addWidget(scroll);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::close);
  layout->addWidget(buttons);
  const int bar = scroll->verticalScrollBar()->sizeHint().width();
  const int whole = keys_and_meanings->sizeHint().width() + bar;
  scroll->setMinimumWidth(std::min(whole, kNarrowest_px));  // on a narrow screen it scrolls sideways, too
  const QSize others = sizeHint() - scroll->sizeHint();
  const QSize available = screen()->availableSize();
  const int most = static_cast<int>(kMaxOfScreen * available.height());
  resize(std::min(std::max(sizeHint().width(), whole + others.width() + 2), available.width()),
         std::min(keys_and_meanings->sizeHint().height() + others.height() + 2, most));
}

}  // namespace scantrove
