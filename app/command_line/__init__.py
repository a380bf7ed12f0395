"""The commands of `lipstitch`, one file each; none but `screenshot` and the demo without a display draws on Qt."""
