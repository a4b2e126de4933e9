namespace perilink {}
