/// @file
/// Labels for the state, its reasons and the checks.
// SPDX-License-Identifier: Apache-2.0
#include "panel/content_view.hpp"

#include <QStringList>
#include <QVBoxLayout>

namespace mtr_rviz {
namespace {

constexpr int kStretched = 2;

QLabel* new_label() {
  auto* label = new QLabel;
  label->setTextFormat(Qt::PlainText);
  label->setAlignment(Qt::AlignTop | Qt::AlignLeft);
  label->setTextInteractionFlags(Qt::TextSelectableByMouse);
  return label;
}

/// Colours with a contrast of at least 4.5 to 1 on white (WCAG 2.1).
QString colour_of(Level level) {
  switch (level) {
    case Level::kGood:
      return "#1b6e2d";
    case Level::kNote:
      return "#8a5a00";
    case Level::kBad:
      return "#b3261e";
    default:
      return "#595959";
  }
}

void set_text(QLabel* label, const QString& text) {
  if (label->text() != text) {
    label->setText(text);
  }
}

/// Sets a style only if it changes, because setting it repeats the whole layout.
void colour(QLabel* label, Level level) {
  const QString style = QString("color: %1; font-weight: bold").arg(colour_of(level));
  if (label->styleSheet() != style) {
    label->setStyleSheet(style);
  }
}

}  // namespace

ContentView::ContentView(QWidget* parent)
    : QWidget(parent), state_(new_label()), reasons_(new_label()), grid_(new QGridLayout) {
  QFont large = state_->font();
  large.setPointSizeF(1.3 * large.pointSizeF());
  state_->setFont(large);
  state_->setWordWrap(true);
  reasons_->setWordWrap(true);
  grid_->setColumnStretch(kStretched, 1);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->addWidget(state_);
  column->addWidget(reasons_);
  column->addLayout(grid_);
}

void ContentView::show_content(const PanelContent& content) {
  const Row& state = content.state;
  const std::string name = state.name.empty() ? "" : state.name + ": ";
  set_text(state_, QString::fromStdString(sign_of(state.level) + "  " + name + state.text));
  colour(state_, state.level);
  QStringList sentences;
  for (const std::string& reason : content.reasons) {
    sentences.append(QString::fromStdString(reason));
  }
  set_text(reasons_, sentences.join('\n'));
  reasons_->setVisible(!sentences.isEmpty());
  for (std::size_t index = 0; index < content.checks.size(); ++index) {
    show_row(index, content.checks[index]);
  }
}

void ContentView::show_row(std::size_t index, const Row& row) {
  while (rows_.size() <= index) {
    const std::array<QLabel*, 3> labels{new_label(), new_label(), new_label()};
    for (int column = 0; column <= kStretched; ++column) {
      grid_->addWidget(labels[static_cast<std::size_t>(column)], static_cast<int>(rows_.size()), column);
    }
    labels[kStretched]->setWordWrap(true);
    rows_.push_back(labels);
  }
  const auto& [sign, name, text] = rows_[index];
  set_text(sign, QString::fromStdString(sign_of(row.level)));
  colour(sign, row.level);
  set_text(name, QString::fromStdString(row.name));
  set_text(text, QString::fromStdString(row.text));
}

}  // namespace mtr_rviz
