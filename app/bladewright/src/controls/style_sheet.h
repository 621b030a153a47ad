// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

namespace bw::app {

/// The rules of the window's stylesheet; @words are replaced by the colours of the theme.
inline constexpr char kStyleSheet[] = R"(
QMainWindow, QDialog { background: @background; }
QMainWindow::separator { background: @line; width: 1px; height: 1px; }
QMainWindow::separator:hover { background: @selection; }
QToolTip { background: @panel; color: @text; border: 1px solid @line; padding: 4px 6px; }

QMenuBar { background: @panel; border-bottom: 1px solid @line; padding: 2px 4px; }
QMenuBar::item { padding: 4px 8px; border-radius: 4px; background: transparent; }
QMenuBar::item:selected { background: @hover; }
QMenu { background: @panel; border: 1px solid @line; padding: 4px; }
QMenu::item { padding: 5px 24px 5px 8px; border-radius: 4px; }
QMenu::item:selected { background: @hover; color: @text; }
QMenu::item:disabled { color: @disabled; }
QMenu::separator { height: 1px; background: @line; margin: 4px 8px; }
QMenu::icon { padding-left: 4px; }

QStatusBar { background: @panel; border-top: 1px solid @line; }
QStatusBar QLabel { color: @secondary; }
QStatusBar::item { border: none; }

QDockWidget { titlebar-close-icon: none; }
QWidget#start { background: @background; }
QScrollArea, QScrollArea > QWidget > QWidget#page { background: @panel; border: none; }
QWidget#panel { background: @panel; border: none; }
QFrame#line { background: @line; border: none; min-height: 1px; max-height: 1px; }
QFrame#vline { background: @line; border: none; min-width: 1px; max-width: 1px; }

QWidget#floating { background: @panel; border: 1px solid @line; border-radius: 6px; }
QLabel#secondary { color: @secondary; }
QLabel#title { color: @text; }
bw--app--ValueLabel { qproperty-errorColour: @error; }
bw--app--ValueLabel[broken="true"] { color: @error; }
bw--app--ValueLabel[stale="true"] { color: @pale; }
QStatusBar bw--app--ValueLabel[stale="true"] { color: @secondaryPale; }
bw--app--ValueLabel[broken="true"][stale="true"] { color: @errorPale; }

QLineEdit, QComboBox {
  background: @field; color: @text; border: 1px solid @line; border-radius: 4px; padding: 2px 6px; min-height: 22px;
  selection-background-color: @selection; selection-color: @onSelection; }
QLineEdit:hover, QComboBox:hover { border-color: @secondary; }
QLineEdit:focus, QComboBox:focus { border-color: @selection; }
QLineEdit:disabled, QComboBox:disabled { color: @disabled; background: @background; }
bw--app--TypedField { qproperty-errorColour: @error; }
QLineEdit[refused="true"], QLineEdit[refused="true"]:focus { border-color: @error; }
QLabel#unit { color: @secondary; background: transparent; }
QLabel#unit:disabled { color: @disabled; }
QLabel#refusal { background: @panel; color: @error; border: 1px solid @error; border-radius: 4px; padding: 4px 8px; }
QComboBox { padding-right: 2px; }
QComboBox::drop-down { border: none; width: 20px; }
QComboBox::down-arrow { image: url(@chevron); width: 14px; height: 14px; }
QComboBox QAbstractItemView { background: @panel; border: 1px solid @line; outline: none; padding: 4px;
  selection-background-color: @hover; selection-color: @text; }

QPushButton { background: @panel; color: @text; border: 1px solid @line; border-radius: 4px; padding: 4px 12px; min-height: 20px; }
QPushButton:hover { border-color: @secondary; }
QPushButton:focus { border-color: @selection; }
QPushButton:pressed { background: @hover; }
QPushButton:disabled { color: @disabled; }
QPushButton#primary { background: @accent; color: @onAccent; border-color: @accent; font-weight: 600; }
QPushButton#primary:hover { background: @accentHover; border-color: @accentHover; }
QPushButton#primary:focus { border-color: @text; }
QPushButton#primary:disabled { background: @background; color: @disabled; border-color: @line; }
QToolButton { background: transparent; border: 1px solid transparent; border-radius: 4px; padding: 3px; color: @text; }
QToolButton:hover { background: @hover; }
QToolButton:focus { border-color: @selection; }
QToolButton:checked { background: @checked; color: @text; }
QToolButton:disabled { color: @disabled; }
QToolButton::menu-indicator { image: none; }
QToolButton#stepHead { border-radius: 0; padding: 8px 16px; text-align: left; }

QCheckBox { spacing: 8px; }
QCheckBox:disabled { color: @disabled; }
QCheckBox::indicator { width: 16px; height: 16px; border: 1px solid @secondary; border-radius: 3px; background: @field; }
QCheckBox::indicator:hover, QCheckBox:focus::indicator { border-color: @selection; }
QCheckBox::indicator:checked { background: @selection; border-color: @selection; image: url(@tick); }
QCheckBox::indicator:disabled { border-color: @line; }

QSlider::groove:horizontal { height: 2px; background: @line; border-radius: 1px; }
QSlider::sub-page:horizontal { background: @selection; border-radius: 1px; }
QSlider::handle:horizontal { width: 12px; height: 12px; margin: -6px 0; border-radius: 7px; background: @panel; border: 1px solid @secondary; }
QSlider::handle:horizontal:hover, QSlider:focus::handle:horizontal { border-color: @selection; }

QProgressBar { background: @line; border: none; border-radius: 1px; min-height: 3px; max-height: 3px; }
QProgressBar::chunk { background: @selection; border-radius: 1px; }

QTabWidget::pane { border: none; border-top: 1px solid @line; background: @panel; }
QTabWidget::tab-bar { left: 8px; }
QTabBar { background: @panel; qproperty-drawBase: 0; }
QTabBar::tab { background: transparent; color: @secondary; padding: 7px 12px; border: none; border-bottom: 2px solid transparent; }
QTabBar::tab:hover { color: @text; }
QTabBar::tab:selected { color: @text; border-bottom-color: @selection; }
QTabBar::tab:focus { color: @selection; }

QListWidget, QListView { background: @panel; border: none; outline: none; }
QListView::item { padding: 6px 8px; border-bottom: 1px solid @line; color: @text; }
QListView::item:hover { background: @hover; }
QListView::item:selected { background: @checked; color: @text; }

QScrollBar:vertical { background: transparent; width: 10px; margin: 0; }
QScrollBar:horizontal { background: transparent; height: 10px; margin: 0; }
QScrollBar::handle { background: @line; border-radius: 3px; margin: 2px; }
QScrollBar::handle:vertical { min-height: 32px; }
QScrollBar::handle:horizontal { min-width: 32px; }
QScrollBar::handle:hover { background: @disabled; }
QScrollBar::add-line, QScrollBar::sub-line { width: 0; height: 0; }
QScrollBar::add-page, QScrollBar::sub-page { background: transparent; }
QSplitter::handle { background: @line; }
)";

}  // namespace bw::app
