"""Colours, fonts and icons of every widget: dark, on Qt's Fusion style.

A palette and a little QSS; `apply` sets them once for the program. Colours are never the only sign:
stages also differ by line style, statuses by lightness.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType

import qtawesome
from PySide6.QtCore import QT_TRANSLATE_NOOP, QCoreApplication, Qt
from PySide6.QtGui import QColor, QFont, QFontDatabase, QIcon, QPalette, QPen
from PySide6.QtWidgets import QApplication

WINDOW = QColor("#23262a")
PANEL = QColor("#1c1f23")
BACKGROUND = QColor("#16181b")  # behind curves, in fields and lists
SUNKEN = QColor("#0f1113")
RAISED = QColor("#2c3035")
BORDER = QColor("#3a3f45")
GRID = QColor("#24282c")
TEXT = QColor("#d7dade")
BRIGHT = QColor("#ffffff")
MUTED = QColor("#9aa0a6")
FAINT = QColor("#6b7177")  # disabled, empty
ACCENT = QColor("#3d7eff")
CHECKED = QColor("#35507f")
LINK = QColor("#6ea8ff")
HIGHLIGHT = QColor("#ffd84d")  # the current thing: bigram, locked pose, letters of the word
WEAK = QColor("#e8893a")
ERROR = QColor("#ff6b6b")
GHOST = QColor("#5b6168")
PLAYHEAD = QColor("#f2f4f6")

#: Colour of each FaceFX pose.
POSE_COLOURS: Mapping[str, QColor] = MappingProxyType(
    {
        "open": QColor("#e8a33d"),
        "W": QColor("#8fb8de"),
        "ShCh": QColor("#7cc48d"),
        "PBM": QColor("#cfc96a"),
        "FV": QColor("#e08a8a"),
        "wide": QColor("#b9a3e3"),
        "tBack": QColor("#6fc9bb"),
        "tRoof": QColor("#d795cf"),
        "tTeeth": QColor("#c09a76"),
    }
)

_CYCLE = tuple(POSE_COLOURS.values())


def pose_colour(pose: str, index: int = 0) -> QColor:
    """Colour of a pose; one that is not of the FaceFX set takes its place `index` in the cycle."""
    return QColor(POSE_COLOURS.get(pose, _CYCLE[index % len(_CYCLE)]))


def mix(colour: QColor, other: QColor, share: float) -> QColor:
    """`share` of `colour` and the rest of `other`, opaque: alpha is dear to paint."""
    parts = ((colour.red(), other.red()), (colour.green(), other.green()), (colour.blue(), other.blue()))
    return QColor(*(round(a * share + b * (1 - share)) for a, b in parts))


@dataclass(frozen=True)
class StageStyle:
    """How one stage of the pipeline is drawn.

    title  English; show `label`
    width  of the line in pixels
    dash   on and off lengths in pixels, () for a solid line
    """

    title: str
    colour: QColor
    width: float
    dash: tuple[float, ...]

    @property
    def label(self) -> str:
        """The title in the user's language."""
        return QCoreApplication.translate("stages", self.title)

    def pen(self, width: float | None = None) -> QPen:
        """A cosmetic pen; `width` overrides the stage's own."""
        pen = QPen(self.colour, self.width if width is None else width)
        pen.setCosmetic(True)
        if self.dash:
            pen.setDashPattern([d / max(pen.widthF(), 1.0) for d in self.dash])
            pen.setCapStyle(Qt.PenCapStyle.FlatCap)
        return pen


_STAGES: tuple[tuple[str, str, float, tuple[float, ...]], ...] = (
    ("red", str(QT_TRANSLATE_NOOP("stages", "Bigram curves")), 1.0, ()),
    ("green", str(QT_TRANSLATE_NOOP("stages", "Stitched (before)")), 1.0, (1.0, 3.0)),
    ("blue", str(QT_TRANSLATE_NOOP("stages", "Stitched")), 1.0, ()),
    ("yellow", str(QT_TRANSLATE_NOOP("stages", "Smoothed")), 1.0, (6.0, 3.0)),
    ("cyan", str(QT_TRANSLATE_NOOP("stages", "Constrained")), 1.0, (8.0, 3.0, 2.0, 3.0)),
    ("magenta", str(QT_TRANSLATE_NOOP("stages", "Speed-limited")), 2.0, ()),
)


def _stage_styles(colours: Sequence[str]) -> Mapping[str, StageStyle]:
    return MappingProxyType(
        {
            key: StageStyle(title, QColor(colour), width, dash)
            for (key, title, width, dash), colour in zip(_STAGES, colours, strict=True)
        }
    )


#: The paper's colours, in pipeline order.
STAGE_STYLES = _stage_styles(("#ff6b6b", "#4fd07a", "#3f8cff", "#ffd84d", "#5ff0ee", "#ff4fd0"))

#: The same stages in colours that remain apart without full colour vision.
STAGE_STYLES_CVD = _stage_styles(("#e68591", "#b0f79f", "#067cfc", "#d3b227", "#5af2f0", "#f237b6"))

#: Bigram status → fill, on one ramp from dark to light.
STATUS_COLOURS: Mapping[str, QColor] = MappingProxyType(
    {
        "empty": QColor("#1b1e22"),
        "suggestion": QColor("#34434f"),
        "draft": QColor("#38678f"),
        "review": QColor("#579bcd"),
        "approved": QColor("#a3d5f2"),
    }
)

_FAMILIES = ("Inter", "Segoe UI", "SF Pro Text", "Noto Sans", "DejaVu Sans")
_MONO_FAMILIES = ("JetBrains Mono", "SF Mono", "Consolas", "Noto Sans Mono", "DejaVu Sans Mono")
POINT_SIZE = 9.5

_QSS = """
QMainWindow::separator{{background:{background};width:4px;height:4px}}
QMainWindow::separator:hover{{background:{accent}}}
QDockWidget{{color:{text};font-weight:600}}
QDockWidget::title{{background:{panel};padding:5px 8px;border-bottom:1px solid {background}}}
QDockWidget[here="true"]::title{{border-bottom:1px solid {accent}}}
QToolBar{{background:{window};border:0;border-bottom:1px solid {background};spacing:4px;padding:4px 6px}}
QStatusBar{{background:{panel};color:{muted}}} QStatusBar::item{{border:0}}
QLineEdit{{background:{background};border:1px solid {border};border-radius:4px;padding:4px 8px}}
QLineEdit:focus{{border-color:{accent}}}
QToolButton{{padding:4px;border:1px solid transparent;border-radius:4px}} QToolButton:hover{{background:{border}}}
QToolButton:checked{{background:{checked}}} QToolButton:focus{{border-color:{accent}}}
QAbstractItemView{{selection-background-color:{checked}}}
QDialogButtonBox{{dialogbuttonbox-buttons-have-icons:0}}
QToolTip{{color:{text};background:{raised};border:1px solid {border};padding:3px 5px}}
"""


def palette() -> QPalette:
    """The dark palette; set explicitly, because a colour scheme hint has no effect on Linux."""
    role = QPalette.ColorRole
    colours = {
        role.Window: WINDOW,
        role.WindowText: TEXT,
        role.Base: BACKGROUND,
        role.AlternateBase: PANEL,
        role.Text: TEXT,
        role.Button: RAISED,
        role.ButtonText: TEXT,
        role.BrightText: BRIGHT,
        role.ToolTipBase: RAISED,
        role.ToolTipText: TEXT,
        role.PlaceholderText: FAINT,
        role.Highlight: ACCENT,
        role.HighlightedText: BRIGHT,
        role.Accent: ACCENT,
        role.Link: LINK,
        role.LinkVisited: LINK,
        role.Light: BORDER,
        role.Midlight: QColor("#33383d"),
        role.Mid: QColor("#1a1c1f"),
        role.Dark: QColor("#141618"),
        role.Shadow: QColor("#0c0d0e"),
    }
    result = QPalette()
    for which, colour in colours.items():
        result.setColor(which, colour)
    for which in (role.Text, role.WindowText, role.ButtonText):
        result.setColor(QPalette.ColorGroup.Disabled, which, FAINT)
    result.setColor(QPalette.ColorGroup.Disabled, role.Highlight, BORDER)
    return result


def _installed(families: Sequence[str]) -> list[str]:
    # Asking Qt for a family that is not there makes it search all aliases and warn.
    known = set(QFontDatabase.families())
    return [family for family in families if family in known]


def font(points: float = POINT_SIZE, *, bold: bool = False) -> QFont:
    """The interface font."""
    result = QFont(QApplication.font())
    if families := _installed(_FAMILIES):
        result.setFamilies(families)
    result.setPointSizeF(points)
    result.setWeight(QFont.Weight.DemiBold if bold else QFont.Weight.Normal)
    return result


def mono_font(points: float = POINT_SIZE) -> QFont:
    """For times and other figures that must not dance."""
    result = QFont(QFontDatabase.systemFont(QFontDatabase.SystemFont.FixedFont))
    if families := _installed(_MONO_FAMILIES):
        result.setFamilies(families)
    result.setPointSizeF(points)
    return result


def apply(app: QApplication) -> None:
    """Fusion, the dark palette, the font and the style sheet for the whole program."""
    app.setStyle("Fusion")
    app.setPalette(palette())
    app.setFont(font())
    names = {
        "window": WINDOW,
        "panel": PANEL,
        "background": BACKGROUND,
        "raised": RAISED,
        "border": BORDER,
        "text": TEXT,
        "muted": MUTED,
        "accent": ACCENT,
        "checked": CHECKED,
    }
    app.setStyleSheet(_QSS.format(**{name: colour.name() for name, colour in names.items()}))


def icon(name: str, colour: QColor | None = None) -> QIcon:
    """A Material Design icon by its name, such as "magnet"; needs a running QApplication.

    qtawesome raises when there is no such icon.
    """
    chosen = TEXT if colour is None else colour
    full = name if "." in name else f"mdi6.{name}"
    return QIcon(qtawesome.icon(full, color=chosen.name(), color_disabled=FAINT.name()))
