// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "window/guide.h"

#include <QFile>
#include <QVBoxLayout>

#include "controls/fields.h"

namespace bw::app {

namespace {

constexpr QSize kSize(720, 560);

}  // namespace

GuideWindow::GuideWindow(const Commands& commands, QWidget* parent)
    : QDialog(parent),
      commands_(commands),
      tabs_(new QTabWidget(this)),
      guide_(new QTextBrowser(tabs_)),
      keys_(new QTextBrowser(tabs_)) {
  setWindowTitle(tr("Guide and keys"));
  auto* layout = makeBox<QVBoxLayout>(this);
  layout->addWidget(tabs_);
  tabs_->setDocumentMode(true);
  tabs_->addTab(guide_, tr("Guide"));
  tabs_->addTab(keys_, tr("Keys"));
  for (QTextBrowser* page : {guide_, keys_}) {
    page->setFrameShape(QFrame::NoFrame);
    page->setOpenExternalLinks(true);
    page->document()->setDocumentMargin(kGroupGap);
  }
  guide_->setAccessibleName(tr("Guide"));
  keys_->setAccessibleName(tr("Keys"));
  QFile file(":/guide/user-guide.md");
  if (file.open(QIODevice::ReadOnly)) guide_->setMarkdown(QString::fromUtf8(file.readAll()));
}

void GuideWindow::open() {
  keys_->setHtml(keysText());
  if (!isVisible()) resize(kSize.boundedTo(parentWidget()->size()));
  show();  // beside the work, not in its way
  raise();
  activateWindow();
}

QString GuideWindow::keysText() const {
  QString text = QStringLiteral("<h2>%1</h2><table cellspacing=\"0\" cellpadding=\"3\">").arg(tr("Commands"));
  const auto line = [&text](const QString& keys, const QString& what) {
    text += QStringLiteral("<tr><td><b>%1</b>&nbsp;&nbsp;</td><td>%2</td></tr>")
                .arg(keys.toHtmlEscaped(), what.toHtmlEscaped());
  };
  for (const QAction* action : commands_.all()) {
    QStringList keys;
    for (const QKeySequence& key : action->shortcuts()) keys << key.toString(QKeySequence::NativeText);
    if (!keys.isEmpty()) line(keys.join(tr(" or ")), commandText(*action));
  }
  text +=
      QStringLiteral("</table><h2>%1</h2><table cellspacing=\"0\" cellpadding=\"3\">").arg(tr("In a field"));
  line(tr("Enter"), tr("Take what is typed, and give the keyboard back to the picture"));
  line(tr("Esc"), tr("Bring the value back, and give the keyboard back to the picture"));
  line(tr("Up, Down"), tr("One step more or less; Page Up and Page Down ten"));
  line(tr("Tab"), tr("Take what is typed and go to the next field"));
  return text + QStringLiteral("</table>");
}

}  // namespace bw::app
