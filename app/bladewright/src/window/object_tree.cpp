// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "window/object_tree.h"

#include <QHeaderView>
#include <QKeyEvent>
#include <QLineEdit>
#include <QSignalBlocker>
#include <QStyledItemDelegate>

#include <functional>
#include <map>
#include <utility>

#include "bw/core/design/surface_curves.h"
#include "bw/core/text/number_text.h"
#include "controls/typed_field.h"

namespace bw::app {

namespace {

constexpr int kLine = Qt::UserRole + 1;
constexpr int kIcon = 16, kSignWidth = 28;

QString text(const std::string& words) { return QString::fromStdString(words); }

/// What the curves of a surface are called, in their order, with the place of each along the travel.
QStringList namesOfCurves(const Source& source) {
  const std::optional<DesignedSurface>& surface = source.surface;
  QStringList names;
  const auto add = [&](const QString& placed, double y) {
    const auto named = source.curveNames.find(int(names.size()));
    const QString place = placed.arg(names.size() + 1);
    names << ObjectTree::tr("%1, y = %2 mm")
                 .arg(named == source.curveNames.end() ? place : text(curveTitle(source, named->first)),
                      text(shortText(y, 4)));
  };
  if (!surface) return names;
  if (const auto* poles = std::get_if<PolesSurface>(&surface->shape))
    for (int row = 0; row < poles->rows; ++row) add(ObjectTree::tr("Row %1"), poles->place(row, 0).y());
  if (const auto* loft = std::get_if<SectionsSurface>(&surface->shape))
    for (const SectionCurve& section : loft->sections) add(ObjectTree::tr("Section %1"), section.y);
  if (const auto* sweep = std::get_if<BladesSurface>(&surface->shape))
    for (const KeyBlade& blade : sweep->blades) add(ObjectTree::tr("Key blade %1"), blade.y);
  return names;
}

/// The editor of a line: of a curve its name alone; where it has none, what it is called instead.
class NameEditor : public QStyledItemDelegate {
 public:
  using Name = std::function<std::optional<ObjectTree::CurveName>(const QModelIndex&)>;
  NameEditor(Name name, QObject* parent) : QStyledItemDelegate(parent), name_(std::move(name)) {}

  void setEditorData(QWidget* editor, const QModelIndex& index) const override {
    auto* line = qobject_cast<QLineEdit*>(editor);
    const auto name = line ? name_(index) : std::nullopt;
    if (!name) return QStyledItemDelegate::setEditorData(editor, index);
    line->setPlaceholderText(name->place);
    line->setText(name->own);
    line->selectAll();
  }

 private:
  Name name_;
};

/// The same whether or not its line is selected.
QIcon iconOf(const char* name, const QColor& colour) {
  QIcon icon;
  for (const QIcon::Mode mode : {QIcon::Normal, QIcon::Selected})
    icon.addPixmap(Theme::pixmap(name, colour, kIcon), mode);
  return icon;
}

}  // namespace

ObjectTree::ObjectTree(Workbench& bench, const Theme& theme, QWidget* parent)
    : QTreeWidget(parent), bench_(bench), theme_(theme) {
  setObjectName("objects");
  setAccessibleName(tr("Objects"));
  setColumnCount(3);
  setHeaderHidden(true);
  setFrameShape(QFrame::NoFrame);
  setIconSize({kIcon, kIcon});
  setIndentation(14);
  setUniformRowHeights(true);
  setEditTriggers(NoEditTriggers);
  setExpandsOnDoubleClick(false);
  setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  header()->setStretchLastSection(false);
  header()->setMinimumSectionSize(kSignWidth);
  header()->setSectionResizeMode(name, QHeaderView::Stretch);
  for (const int column : {int(seen), int(kept)}) {
    header()->setSectionResizeMode(column, QHeaderView::Fixed);
    header()->resizeSection(column, kSignWidth);
  }
  setItemDelegateForColumn(name, new NameEditor(
                                     [this](const QModelIndex& index) {
                                       const QTreeWidgetItem* item = itemFromIndex(index);
                                       return item ? nameOfCurve(*item) : std::nullopt;
                                     },
                                     this));
  connect(this, &QTreeWidget::itemClicked, this, [this](QTreeWidgetItem* item, int column) {
    if (column == name)
      select(*item);
    else
      toggle(*item, column);
  });
  connect(this, &QTreeWidget::itemActivated, this, [this](QTreeWidgetItem* item, int column) {
    if (column == name) select(*item);
  });
  connect(this, &QTreeWidget::itemDoubleClicked, this, [this](QTreeWidgetItem* item, int column) {
    if (column == name) beginRenaming(*item);
  });
  connect(this, &QTreeWidget::itemChanged, this, [this](QTreeWidgetItem* item) {
    if (!busy_) rename(*item);
  });
  connect(this, &QTreeWidget::itemExpanded, this, [this](QTreeWidgetItem* item) {
    const std::optional<Object>& object = lineOf(*item).object;
    if (object && object->kind == Object::Kind::stations) fillStations(*item);
    if (object && object->kind == Object::Kind::surface) fillCurves(*item);
  });
  connect(&bench, &Workbench::changed, this, &ObjectTree::follow);
  connect(&bench, &Workbench::objectsChanged, this, &ObjectTree::paintAll);
  connect(&theme, &Theme::changed, this, [this] {
    built_.clear();
    rebuild();
  });
  rebuild();
}

const ObjectTree::Line& ObjectTree::lineOf(const QTreeWidgetItem& item) const {
  return lines_[std::size_t(item.data(name, kLine).toInt())];
}

QTreeWidgetItem* ObjectTree::lineOf(const Object& object) const {
  for (QTreeWidgetItemIterator at(const_cast<ObjectTree*>(this)); *at; ++at)
    if (lineOf(**at).object == object) return *at;
  return nullptr;
}

QTreeWidgetItem* ObjectTree::addLine(QTreeWidgetItem* parent, const QString& text, const char* icon,
                                     const Line& line) {
  auto* item = parent ? new QTreeWidgetItem(parent) : new QTreeWidgetItem(this);
  item->setData(name, kLine, int(lines_.size()));
  lines_.push_back(line);
  item->setText(name, text);
  if (icon) item->setIcon(name, iconOf(icon, theme_.colours().secondary));
  const bool named = line.object && line.object->kind != Object::Kind::stations;
  item->setFlags(Qt::ItemIsEnabled | Qt::ItemIsSelectable | (named ? Qt::ItemIsEditable : Qt::NoItemFlags));
  return item;
}

void ObjectTree::fillCurves(QTreeWidgetItem& surface) {
  const Line line = lineOf(surface);
  const QStringList names = namesOfCurves(*bench_.design().find(line.object->id));
  if (surface.childCount() > 0) return;
  const bool busy = std::exchange(busy_, true);
  for (int i = 0; i < names.size(); ++i) {
    const Line curve{Object{Object::Kind::curve, curveId(line.object->id, i)}, line.block, line.cut, -1, i};
    paint(*addLine(&surface, names[i], nullptr, curve));
  }
  busy_ = busy;
  markSelected();
}

void ObjectTree::rebuild() {
  // What is there and how it is called; numbers do not matter.
  const Design& design = bench_.design();
  std::string now = design.grid ? "grid\n" : "";
  for (const StockBlock& block : design.stock) now += block.id + "\n";
  for (const Cut& cut : design.cuts) now += "\t" + cut.id + "\t" + cut.block + "\t" + cut.source + "\n";
  for (const Source& source : design.sources) now += namesOfCurves(source).join(' ').toStdString() + "\n";
  if (std::exchange(built_, now) == now) return;
  busy_ = true;
  std::map<std::pair<Object, std::string>, bool> open;  // of each object, of each cut
  for (QTreeWidgetItemIterator at(this); *at; ++at)
    if (const Line& line = lineOf(**at); line.object) open[{*line.object, line.cut}] = (*at)->isExpanded();
  clear();
  lines_.clear();
  for (const StockBlock& block : design.stock) {
    std::vector<const Cut*> cuts;
    for (const Cut& cut : design.cuts)
      if (cut.block == block.id) cuts.push_back(&cut);
    const std::string first = cuts.empty() ? std::string() : cuts.front()->id;
    QTreeWidgetItem* top =
        addLine(nullptr, text(block.id), "block", {Object{Object::Kind::block, block.id}, block.id, first});
    for (const Cut* cut : cuts) {
      QTreeWidgetItem* line =
          addLine(top, text(cut->id), "cut", {Object{Object::Kind::cut, cut->id}, block.id, cut->id});
      QTreeWidgetItem* surface = addLine(line, text(cut->source), "surface",
                                         {Object{Object::Kind::surface, cut->source}, block.id, cut->id});
      // Its curves are listed once they are to be seen.
      if (const auto& designed = design.find(cut->source)->surface; designed && curveCount(*designed) > 0)
        surface->setChildIndicatorPolicy(QTreeWidgetItem::ShowIndicator);
      addLine(line, tr("Stations"), "station", {Object{Object::Kind::stations, cut->id}, block.id, cut->id});
    }
  }
  // Of many blocks none is open at first.
  constexpr std::size_t kOpen = 4;
  for (QTreeWidgetItemIterator at(this); *at; ++at) {
    const auto& object = lineOf(**at).object;
    if (!object) continue;
    const bool first = object->kind == Object::Kind::cut ||
                       (object->kind == Object::Kind::block && design.stock.size() <= kOpen);
    const auto known = open.find({*object, lineOf(**at).cut});
    (*at)->setExpanded(known == open.end() ? first : known->second);
  }
  busy_ = false;
  refreshStations();
  paintAll();
  markSelected();
}

void ObjectTree::refreshStations() {
  busy_ = true;
  const auto shown = bench_.shown();
  for (QTreeWidgetItemIterator at(this); *at; ++at) {
    const Line& line = lineOf(**at);
    if (!line.object || line.object->kind != Object::Kind::stations) continue;
    const pipeline::CutEvaluation* cut = shown ? shown->find(line.cut) : nullptr;
    const auto result = cut ? cut->result() : std::nullopt;
    const int count = result ? int(result->size()) : 0;
    (*at)->setText(name, count ? tr("%1 stations").arg(count) : tr("Stations"));
    (*at)->setChildIndicatorPolicy(count ? QTreeWidgetItem::ShowIndicator
                                         : QTreeWidgetItem::DontShowIndicator);
    if ((*at)->childCount() > 0 && (*at)->childCount() != count) {
      (*at)->setExpanded(false);
      qDeleteAll((*at)->takeChildren());
    }
  }
  busy_ = false;
}

void ObjectTree::fillStations(QTreeWidgetItem& stations) {
  const Line line = lineOf(stations);
  const auto shown = bench_.shown();
  const pipeline::CutEvaluation* cut = shown ? shown->find(line.cut) : nullptr;
  const auto result = cut ? cut->result() : std::nullopt;
  if (!result || stations.childCount() > 0) return;
  busy_ = true;
  for (std::size_t i = 0; i < result->size(); ++i) {
    Line station{{}, line.block, line.cut, int(i)};
    addLine(&stations, tr("Station %1").arg(result->sweep.poses[i].index + 1), nullptr, station);
  }
  busy_ = false;
  markSelected();
}

void ObjectTree::paint(QTreeWidgetItem& item) {
  const Line& line = lineOf(item);
  if (!line.object) return;
  const Colours& c = theme_.colours();
  const QString what = item.text(name);
  const auto sign = [&](int column, const char* icon, bool loud, const QString& words) {
    item.setIcon(column, iconOf(icon, loud ? c.text : c.disabled));
    item.setToolTip(column, words);
    item.setData(column, Qt::AccessibleTextRole, words);
  };
  const bool hidden = bench_.hidden(*line.object);
  sign(seen, hidden ? "eye-off" : "eye", hidden,
       hidden ? tr("%1 is hidden").arg(what) : tr("%1 is shown").arg(what));
  item.setForeground(name, hidden ? c.secondary : c.text);
  const bool stations = line.object->kind == Object::Kind::stations;
  const bool locked = bench_.locked(*line.object);
  sign(kept, locked ? "lock" : "lock-open", locked,
       stations ? locked ? tr("How many stations there are is locked: nothing changes it")
                         : tr("How many stations there are may be changed")
       : locked ? tr("%1 is locked: nothing changes it").arg(what)
                : tr("%1 may be changed").arg(what));
  if (stations) return;
  const bool named = item.flags() & Qt::ItemIsEditable;
  item.setToolTip(name, named ? tr("%1 (F2 gives it another name)").arg(what) : what);
}

void ObjectTree::paintAll() {
  busy_ = true;
  for (QTreeWidgetItemIterator at(this); *at; ++at) paint(**at);
  busy_ = false;
}

void ObjectTree::follow(const Change& change) {
  if (change.any(Aspect::design)) rebuild();
  if (change.any(Aspect::result)) refreshStations();
  if (change.any(Aspect::selection)) curve_.reset();
  if (change.any(Aspect::selection | Aspect::design)) markSelected();
}

void ObjectTree::showCurve(const std::optional<int>& curve) {
  curve_ = curve;
  markSelected();
}

void ObjectTree::markSelected() {
  const Selection& now = bench_.selection();
  const QSignalBlocker quiet(this);
  for (QTreeWidgetItemIterator at(this); *at; ++at) {
    const Line& line = lineOf(**at);
    const bool same = line.cut == now.cut;
    const Object::Kind kind = curve_                                 ? Object::Kind::surface
                              : now.kind == Selection::Kind::block   ? Object::Kind::block
                              : now.kind == Selection::Kind::surface ? Object::Kind::surface
                              : now.kind == Selection::Kind::station ? Object::Kind::stations
                                                                     : Object::Kind::cut;
    const bool isIt = kind == Object::Kind::block ? line.object == Object{kind, now.block}
                      : line.station >= 0         ? same && line.station == now.station
                                                  : same && line.object && line.object->kind == kind;
    if (!isIt) continue;
    if (curve_ && (*at)->isExpanded() && *curve_ < (*at)->childCount())
      return setCurrentItem((*at)->child(*curve_));
    setCurrentItem(*at);
    // Of a station that is listed its own line, which comes after that of all.
    if (kind != Object::Kind::stations || line.station >= 0 || (*at)->childCount() == 0) return;
  }
}

void ObjectTree::select(const QTreeWidgetItem& item) {
  const Line line = lineOf(item);
  if (line.cut.empty()) return;
  Selection next{Selection::Kind::surface, -1, line.block, line.cut};
  if (line.station >= 0) {
    next.kind = Selection::Kind::station;
    next.station = line.station;
  } else if (line.object && line.object->kind == Object::Kind::block) {
    next.kind = Selection::Kind::block;
  } else if (line.object && line.object->kind != Object::Kind::surface && line.curve < 0) {
    next.kind = Selection::Kind::result;
  }
  bench_.select(next);
  if (next.kind == Selection::Kind::surface)
    emit curveChosen(line.curve < 0 ? std::nullopt : std::optional(line.curve));
}

void ObjectTree::toggle(const QTreeWidgetItem& item, int column) {
  const std::optional<Object> object = lineOf(item).object;
  if (!object) return;
  if (column == seen)
    bench_.setHidden(*object, !bench_.hidden(*object));
  else
    bench_.setLocked(*object, !bench_.locked(*object));
}

std::optional<ObjectTree::CurveName> ObjectTree::nameOfCurve(const QTreeWidgetItem& item) const {
  const Line& line = lineOf(item);
  if (!line.object || line.object->kind != Object::Kind::curve) return {};
  const std::optional<CurveOfSource> curve = curveOf(bench_.design(), line.object->id);
  const Source* source = curve ? bench_.design().find(curve->source) : nullptr;
  if (!source) return {};
  const auto named = source->curveNames.find(curve->curve);
  return CurveName{named == source->curveNames.end() ? QString() : text(named->second),
                   text(curveWord(*source->surface, curve->curve))};
}

void ObjectTree::beginRenaming(QTreeWidgetItem& item) {
  if (item.flags() & Qt::ItemIsEditable) editItem(&item, name);
}

void ObjectTree::rename(const QTreeWidgetItem& item) {
  const std::optional<Object> object = lineOf(item).object;
  if (!object || object->kind == Object::Kind::stations) return;
  // Once the editor is done with the line: another name builds all of them anew.
  QMetaObject::invokeMethod(
      this,
      [this, object = *object, next = item.text(name).trimmed().toStdString()] {
        (void)bench_.rename(object, next);  // which tells why not
        built_.clear();                     // what was refused, or is locked, is called as before
        rebuild();
      },
      Qt::QueuedConnection);
}

void ObjectTree::keyPressEvent(QKeyEvent* event) {
  QTreeWidgetItem* item = currentItem();
  if (item && event->modifiers() == Qt::NoModifier) {
    if (event->key() == Qt::Key_V) return toggle(*item, seen);
    if (event->key() == Qt::Key_L) return toggle(*item, kept);
    if (event->key() == Qt::Key_F2) return beginRenaming(*item);
    if (event->key() == Qt::Key_Escape && returnKeyboard(*this)) return;
  }
  QTreeWidget::keyPressEvent(event);
}

}  // namespace bw::app
