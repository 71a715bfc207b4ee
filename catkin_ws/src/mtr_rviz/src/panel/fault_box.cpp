/// @file
/// Selection of a fault to inject, and list of active faults.
// SPDX-License-Identifier: Apache-2.0
#include "panel/fault_box.hpp"

#include <QGridLayout>
#include <QStringList>

namespace mtr_rviz {
namespace {

/// Defaults of `inject`: duration in s, and default amount of a kind.
constexpr double kUsualDurationS = 1.0;
constexpr double kUsualAmount = 0.0;
/// Range accepted by the node.
constexpr double kMinDurationS = 0.1;
constexpr double kMaxDurationS = 3600.0;

}  // namespace

FaultBox::FaultBox(QWidget* parent)
    : QGroupBox("Faults", parent),
      part_(new QComboBox),
      kind_(new QComboBox),
      duration_s_(new QDoubleSpinBox),
      inject_(new QPushButton("Inject")),
      end_(new QPushButton("End")),
      said_(new QLabel),
      caller_(new FaultCaller(this)) {
  duration_s_->setRange(kMinDurationS, kMaxDurationS);
  duration_s_->setDecimals(1);
  duration_s_->setSuffix(" s");
  duration_s_->setValue(kUsualDurationS);
  said_->setWordWrap(true);
  said_->setTextFormat(Qt::PlainText);
  auto* grid = new QGridLayout(this);
  grid->addWidget(part_, 0, 0);
  grid->addWidget(kind_, 0, 1);
  grid->addWidget(duration_s_, 0, 2);
  grid->addWidget(inject_, 1, 0);
  grid->addWidget(end_, 1, 1);
  grid->addWidget(said_, 2, 0, 1, 3);
  connect(part_, &QComboBox::currentTextChanged, this, &FaultBox::show_kinds);
  connect(inject_, &QPushButton::clicked, this, [this] { inject(kind_->currentText()); });
  connect(end_, &QPushButton::clicked, this, [this] { inject(kNoFault); });
  connect(caller_, &FaultCaller::answered, this, [this](bool, const QString& sentence) { answer_ = sentence; });
  hide();
}

void FaultBox::show_content(const PanelContent& content, const FaultCatalogue& catalogue) {
  setVisible(content.can_inject && !catalogue.empty());
  if (catalogue != catalogue_) {
    catalogue_ = catalogue;
    part_->clear();
    for (const auto& [part, kinds] : catalogue_) {
      part_->addItem(QString::fromStdString(part));
    }
  }
  QStringList sentences;
  for (const std::string& fault : content.faults) {
    sentences.append(QString::fromStdString(fault));
  }
  if (!answer_.isEmpty()) {
    sentences.append(answer_);
  }
  said_->setText(sentences.join('\n'));
}

void FaultBox::show_kinds() {
  kind_->clear();
  const auto part = catalogue_.find(part_->currentText().toStdString());
  if (part != catalogue_.end()) {
    for (const std::string& kind : part->second) {
      kind_->addItem(QString::fromStdString(kind));
    }
  }
}

void FaultBox::inject(const QString& kind) {
  const auto order = order_of(
      catalogue_, {part_->currentText().toStdString(), kind.toStdString(), duration_s_->value(), kUsualAmount});
  if (order) {
    caller_->call(*order);
  }
}

}  // namespace mtr_rviz
