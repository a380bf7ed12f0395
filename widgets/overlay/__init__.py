"""What the pipeline made of the sentence, stage by stage."""
