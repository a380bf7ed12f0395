"""Recordings as Live Link Face writes them, with whatever shall be wrong about them."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping

import numpy as np

#: The 52 shapes of ARKit in Live Link Face's order and spelling, and the angles of head and eyes.
_NAMES = (
    "EyeBlinkLeft EyeLookDownLeft EyeLookInLeft EyeLookOutLeft EyeLookUpLeft EyeSquintLeft EyeWideLeft "
    "EyeBlinkRight EyeLookDownRight EyeLookInRight EyeLookOutRight EyeLookUpRight EyeSquintRight EyeWideRight "
    "JawForward JawRight JawLeft JawOpen MouthClose MouthFunnel MouthPucker MouthRight MouthLeft MouthSmileLeft "
    "MouthSmileRight MouthFrownLeft MouthFrownRight MouthDimpleLeft MouthDimpleRight MouthStretchLeft "
    "MouthStretchRight MouthRollLower MouthRollUpper MouthShrugLower MouthShrugUpper MouthPressLeft MouthPressRight "
    "MouthLowerDownLeft MouthLowerDownRight MouthUpperUpLeft MouthUpperUpRight BrowDownLeft BrowDownRight "
    "BrowInnerUp BrowOuterUpLeft BrowOuterUpRight CheekPuff CheekSquintLeft CheekSquintRight NoseSneerLeft "
    "NoseSneerRight TongueOut HeadYaw HeadPitch HeadRoll LeftEyeYaw LeftEyePitch LeftEyeRoll RightEyeYaw "
    "RightEyePitch RightEyeRoll"
)
ARKIT = tuple(_NAMES.split())


def live_link(
    seconds: float,
    fps: int,
    base: int = 60,
    *,
    start: float = 69_054.0,
    lost: Collection[int] = (),
    dropped: Collection[int] = (),
    frame: Callable[[int], float] | None = None,
    channels: Mapping[str, np.ndarray] | None = None,
) -> tuple[bytes, np.ndarray]:
    """(the file, JawOpen of every frame of the camera). `frame` makes another frame field than that of `base`.

    channels  what some shapes do, one value a frame; without, JawOpen swings
    """
    count = round(seconds * fps) + 1
    jaw = 0.3 + 0.25 * np.sin(np.arange(count) / fps * 7)
    moving = {"JawOpen": jaw} if channels is None else channels
    lines = [",".join(["Timecode", "BlendshapeCount", *ARKIT])]
    for i in range(count):
        if i in dropped:
            continue
        at = start + i / fps
        whole = int(at + 1e-9)
        field = frame(i) if frame else (at - whole) * base
        clock = f"{whole // 3600 % 24:02}:{whole // 60 % 60:02}:{whole % 60:02}:{field:06.3f}"
        if i in lost:
            lines.append(f"{clock},0")
        else:
            values = [moving[name][i] if name in moving else 0.0 for name in ARKIT]
            lines.append(f"{clock},61," + ",".join(f"{v:.6f}" for v in values))
    return ("\n".join(lines) + "\n").encode(), moving.get("JawOpen", jaw)
